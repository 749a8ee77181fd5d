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

struct PersonLabels {
  int id = 0;
  std::vector<LandmarkLabel> landmarks;
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
