// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace poselift {

// What a person (or a detector) said about landmarks in pictures.

enum class LabelState { kVisible, kOccluded, kAbsent };

struct LandmarkLabel {
  std::string name;  // a landmark of the layout, e.g. "left_knee", "nose"
  Eigen::Vector2d x_px = Eigen::Vector2d::Zero();  // integer = pixel centre
  LabelState state = LabelState::kVisible;
  std::optional<double> radius_px;  // standard deviation
};

// What a person knows of a body that no landmark shows. Joints are the 23 joints or
// landmarks of the layout, depth is along z of cam.
struct LabelHint {
  enum class Kind {
    kNearer,          // `joint` is nearer to the camera than `other`, by metres_m at least
    kTowardsCamera,   // the bone that ends at `joint` (one of the 23) has its end nearer than its
    kAwayFromCamera,  // start, by metres_m at least; or farther
    kOnFloor,         // `joint` is on the floor, which is level in cam; no joint is below
    kHeight,          // the person is metres_m tall, from the soles to the crown
    kPin              // `joint` is at x_in_cam_m from the pelvis, give or take metres_m
  };
  Kind kind = Kind::kNearer;
  std::string joint = {};
  std::string other = {};
  std::optional<double> metres_m = {};  // kHeight wants it
  Eigen::Vector3d x_in_cam_m = Eigen::Vector3d::Zero();
};

struct PersonLabels {
  int id = 0;
  std::vector<LandmarkLabel> landmarks;
  std::vector<LabelHint> hints = {};
  // Followed from other frames, or put between them: not what a person said of this frame.
  bool is_propagated = false;
};

struct FrameLabels {
  std::string image;  // path as the file gives it, made relative to nothing; may be empty
  int width_px = 0;   // 0: not said
  int height_px = 0;
  std::optional<double> time_s;
  std::optional<int> frame;  // of the video that `image` names, counted from 0
  std::vector<PersonLabels> people;
};

struct Labels {
  std::string layout;  // "body15", "coco17", ...
  std::vector<FrameLabels> frames;
};

}  // namespace poselift
