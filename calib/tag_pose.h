// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "src/camera.h"
#include "src/tag_detection.h"

namespace poselift {

// Where a tag is, from its four corners in the picture of a calibrated camera: minimises
//   e(R, t) = sum_i | project(R x_i + t) - corner_i |^2                x_i = TagCorners_m
// through the true lens model, by Levenberg-Marquardt from both solutions of IPPE (Collins and
// Bartoli 2014). A square seen from afar looks the same tilted one way and the other: then e has
// two minima, of which noise makes either the lower. Both are kept.

struct TagPoseOptions {
  // Standard deviation of a corner's coordinate. TagDetector's corners are off by 0.01 px at
  // little noise, by 0.02 px at 4 grey levels of it; cloth, paper and blur add their share.
  double corner_sigma_px = 0.1;
  double ambiguous_odds = 100.0;  // ambiguous unless the better is likelier by this factor
  double uncertain_rad = 0.1;

  std::string Validate() const;
};

struct TagPoses {
  std::vector<TagPose> poses;  // the better first; empty when the corners show no tag
  // The corners alone do not tell how the tag is tilted: e of the second is so little more than
  // that of the first, exp((e2 - e1) / (2 sigma^2)) below ambiguous_odds; or there is but one
  // and its mirror image is as likely, or its rotation has a standard deviation above
  // uncertain_rad.
  bool is_ambiguous = false;
};

// corners_px in the order of TagDetection. One pose where both minima are the same.
TagPoses FindTagPoses(const Camera& camera, const Eigen::Matrix<double, 2, 4>& corners_px,
                      double size_m, const TagPoseOptions& options = {});

// What else is known of a tag: each makes a pose the less likely the farther off it is, up to
// five sigmas.
struct TagPoseHints {
  struct Pose {
    Eigen::Isometry3d cam_from_tag = Eigen::Isometry3d::Identity();
    double sigma_rad = 0.2;
    double sigma_m = 0.1;
  };
  std::optional<Pose> last;  // sigmas: how far it may have moved since

  struct Orientation {
    Eigen::Quaterniond cam_from_tag = Eigen::Quaterniond::Identity();
    double sigma_rad = 0.5;
  };
  std::optional<Orientation> body;  // the orientation that the body's pose wants

  struct Gravity {
    Eigen::Vector3d down_in_cam = Eigen::Vector3d::UnitY();
    Eigen::Vector3d down_in_tag = Eigen::Vector3d::UnitY();  // how it hangs, about
    double sigma_rad = 0.5;
  };
  std::optional<Gravity> gravity;
};

struct TagPoseChoice {
  size_t index = 0;           // of TagPoses::poses
  double log_odds = 0.0;      // against the other; infinite when there is none
  bool is_ambiguous = false;  // below the logarithm of ambiguous_odds
};

// Corners and hints together. Throws std::invalid_argument when there are no poses.
TagPoseChoice ChooseTagPose(const TagPoses& found, const TagPoseHints& hints,
                            const TagPoseOptions& options = {});

// The same tag in the axes that apriltag_ros gives out: y up, z out of the paper.
Eigen::Isometry3d CamFromRosTag(const Eigen::Isometry3d& cam_from_tag);

}  // namespace poselift
