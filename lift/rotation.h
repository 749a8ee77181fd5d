// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "lift/projection_operator.h"

namespace poselift {

// tau of the sparse coding paper: the angles about the body's x (pitch), y
// (yaw) and z (roll) axes that turn a body that faces a level camera,
//   cam_from_body = F Rz(tau_z) Rx(tau_x) Ry(tau_y),   F = diag(1, -1, -1).
// Yaw is applied first, so that pitch and roll are the camera's tilt.
Eigen::Matrix3d CamFromBody(const Eigen::Vector3d& tau_rad);

// The inverse; pitch in [-pi/2, pi/2], yaw and roll in (-pi, pi].
Eigen::Vector3d TauFromRotation(const Eigen::Matrix3d& cam_from_body);

// dR/dtau_i. R(tau + pi/2 e_i) is this derivative plus the constant entry of
// the rotation about axis i: Eq. (13) as printed keeps that entry.
std::array<Eigen::Matrix3d, 3> CamFromBodyDerivatives(const Eigen::Vector3d& tau_rad);

struct RotationOptions {
  Eigen::Vector3d prior_tau_rad = Eigen::Vector3d::Zero();  // tau_0
  // W, per radian: how strongly tau is drawn to tau_0. Yaw is free: people are
  // seen from all sides, tilted less often.
  Eigen::Vector3d prior_weight = Eigen::Vector3d(1.0, 0.0, 1.0);
  int max_iterations = 20;

  std::string Validate() const;
};

struct RotationEstimate {
  Eigen::Vector3d tau_rad;
  double objective = -1.0;  // Eq. (12)
};

// |W (tau - tau_0)|^2.
double RotationPriorCost(const Eigen::Vector3d& tau_rad, const RotationOptions& options);

// (P1b): min over tau of |P{tau o y} - y_0|^2 + |W (tau - tau_0)|^2, Eq. (12),
// with the relations in both, by Levenberg-Marquardt from tau_start; never worse than the start.
// centred_points: of the pose y, from op.CentredPoints().
RotationEstimate EstimateRotation(const ProjectionOperator& op,
                                  const Eigen::Ref<const Eigen::Matrix3Xd>& centred_points,
                                  double scale_px_per_m, const Eigen::Vector3d& tau_start_rad,
                                  const RotationOptions& options);

}  // namespace poselift
