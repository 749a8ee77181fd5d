// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace poselift {

// dw/dq: how a change of the coefficients x y z w turns the root,
// R = Exp(w) R0. It is 2 (dq conj(q))_xyz.
inline Eigen::Matrix<double, 3, 4> RotationByCoefficients(const Eigen::Quaterniond& q) {
  Eigen::Matrix<double, 3, 4> jacobian;
  jacobian << q.w(), -q.z(), q.y(), -q.x(),  //
      q.z(), q.w(), -q.x(), -q.y(),          //
      -q.y(), q.x(), q.w(), -q.z();
  return 2.0 * jacobian;
}

// [x]: x crossed with what stands behind it.
inline Eigen::Matrix3d Cross(const Eigen::Vector3d& x) {
  Eigen::Matrix3d cross;
  cross << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return cross;
}

}  // namespace poselift
