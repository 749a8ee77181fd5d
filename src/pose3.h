// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

#include "src/joints.h"

namespace poselift {

// Joint positions: 3 x J, column = joint, in the frame and unit the variable's
// name says. Stacked as x0 y0 z0 x1 ... it is a column of the dictionary.
// A joint that is not there has NaN coordinates.
using Pose3 = Eigen::Matrix3Xd;

inline Eigen::Map<const Eigen::VectorXd> Stacked(const Pose3& pose) {
  return {pose.data(), pose.size()};
}

inline Pose3 Unstacked(const Eigen::Ref<const Eigen::VectorXd>& stacked) {
  return Eigen::Map<const Pose3>(stacked.data(), 3, stacked.size() / 3);
}

// The left-right mirrored pose in the body frame (x is the subject's left).
Pose3 MirroredInBody(const Pose3& joints_in_body);

}  // namespace poselift
