// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "src/poses.h"

namespace poselift {

// What it takes to put the motion back before the camera.
struct CameraTrack {
  Eigen::Vector3d world_in_level_cam_m = Eigen::Vector3d::Zero();  // world's origin, level axes
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  bool has_depth = false;              // pelvis_in_cam_m was known
  double focal_px = kUnknown;          // with depth: scale = focal_px / depth
  std::vector<double> scale_px_per_m;  // without: of each frame, straight lines over gaps
};

// From the poses of a person, null where there is none; without the scales.
CameraTrack FindCamera(const std::vector<const PersonPose*>& people);

}  // namespace poselift
