// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "src/pose3.h"

namespace poselift {

// The weak-perspective camera:
//   x_in_cam = cam_from_body x_in_body
//   x_px     = scale_px_per_m (x_in_cam)_xy + translation_px
struct WeakCamera {
  Eigen::Matrix3d cam_from_body = Eigen::Vector3d(1, -1, -1).asDiagonal();  // facing the camera
  double scale_px_per_m = 1.0;
  Eigen::Vector2d translation_px = Eigen::Vector2d::Zero();

  Eigen::Matrix2Xd Project(const Pose3& joints_in_cam_m) const {
    return (scale_px_per_m * joints_in_cam_m.topRows<2>()).colwise() + translation_px;
  }
};

}  // namespace poselift
