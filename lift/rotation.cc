// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/rotation.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace poselift {
namespace {

const Eigen::DiagonalMatrix<double, 3> kFacing(1, -1, -1);

Eigen::Matrix3d AxisRotation(int axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

Eigen::Matrix3d AxisDerivative(int axis, double angle_rad) {
  Eigen::Matrix3d shifted = AxisRotation(axis, angle_rad + M_PI / 2);
  shifted(axis, axis) = 0.0;
  return shifted;
}

// tau - tau_0 with each angle in (-pi, pi].
Eigen::Vector3d FromPrior(const Eigen::Vector3d& tau_rad, const RotationOptions& options) {
  const Eigen::Vector3d difference = tau_rad - options.prior_tau_rad;
  return difference.unaryExpr([](double a) { return std::remainder(a, 2 * M_PI); });
}

}  // namespace

std::string RotationOptions::Validate() const {
  if (!prior_tau_rad.allFinite()) return "RotationOptions::prior_tau_rad is not finite";
  if (!(prior_weight.minCoeff() >= 0.0) || !prior_weight.allFinite())
    return "RotationOptions::prior_weight has a negative entry, wanted at least 0";
  if (max_iterations < 1)
    return fmt::format("RotationOptions::max_iterations = {}, wanted at least 1", max_iterations);
  return "";
}

Eigen::Matrix3d CamFromBody(const Eigen::Vector3d& tau_rad) {
  return kFacing * AxisRotation(2, tau_rad.z()) * AxisRotation(0, tau_rad.x()) *
         AxisRotation(1, tau_rad.y());
}

Eigen::Vector3d TauFromRotation(const Eigen::Matrix3d& cam_from_body) {
  // Rz(c) Rx(a) Ry(b): last row is (-cos a sin b, sin a, cos a cos b).
  const Eigen::Matrix3d R = kFacing * cam_from_body;
  const double cos_pitch = std::hypot(R(2, 0), R(2, 2));
  const double pitch = std::atan2(R(2, 1), cos_pitch);  // asin would lose half the digits here
  if (cos_pitch < 1e-9)  // looking along the body: only yaw and roll together are known
    return {pitch, 0.0, std::atan2(R(1, 0), R(0, 0))};
  return {pitch, std::atan2(-R(2, 0), R(2, 2)), std::atan2(-R(0, 1), R(1, 1))};
}

std::array<Eigen::Matrix3d, 3> CamFromBodyDerivatives(const Eigen::Vector3d& tau_rad) {
  const Eigen::Matrix3d Rx = AxisRotation(0, tau_rad.x());
  const Eigen::Matrix3d Ry = AxisRotation(1, tau_rad.y());
  const Eigen::Matrix3d Rz = AxisRotation(2, tau_rad.z());
  return {kFacing * Rz * AxisDerivative(0, tau_rad.x()) * Ry,
          kFacing * Rz * Rx * AxisDerivative(1, tau_rad.y()),
          kFacing * AxisDerivative(2, tau_rad.z()) * Rx * Ry};
}

double RotationPriorCost(const Eigen::Vector3d& tau_rad, const RotationOptions& options) {
  return options.prior_weight.cwiseProduct(FromPrior(tau_rad, options)).squaredNorm();
}

RotationEstimate EstimateRotation(const ProjectionOperator& op,
                                  const Eigen::Ref<const Eigen::Matrix3Xd>& centred_points,
                                  double scale_px_per_m, const Eigen::Vector3d& tau_start_rad,
                                  const RotationOptions& options) {
  const auto residual_at = [&](const Eigen::Vector3d& tau) -> Eigen::VectorXd {
    return op.Residual(CamFromBody(tau), scale_px_per_m, centred_points);
  };
  RotationEstimate estimate{tau_start_rad};
  Eigen::VectorXd residual = residual_at(tau_start_rad);
  estimate.objective = residual.squaredNorm() + RotationPriorCost(tau_start_rad, options);

  const Eigen::Matrix3d prior_hessian = options.prior_weight.cwiseAbs2().asDiagonal();
  double damping = 1e-4;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    Eigen::MatrixX3d jacobian(residual.size(), 3);
    const auto derivatives = CamFromBodyDerivatives(estimate.tau_rad);
    for (int i = 0; i < 3; ++i)
      jacobian.col(i) = op.Rows(derivatives[i], scale_px_per_m, centred_points);
    if (op.HasLowerBounds()) jacobian.array().colwise() *= op.ActiveRows(residual);
    const Eigen::Matrix3d hessian = jacobian.transpose() * jacobian + prior_hessian;
    const Eigen::Vector3d gradient =
        jacobian.transpose() * residual + prior_hessian * FromPrior(estimate.tau_rad, options);
    bool improved = false;
    double gain = 0.0;
    for (int attempt = 0; attempt < 8 && !improved; ++attempt) {
      Eigen::Matrix3d damped = hessian;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-12 * hessian.trace() + 1e-300;
      const Eigen::Vector3d candidate = estimate.tau_rad - damped.ldlt().solve(gradient);
      const Eigen::VectorXd candidate_residual = residual_at(candidate);
      const double objective =
          candidate_residual.squaredNorm() + RotationPriorCost(candidate, options);
      improved = objective < estimate.objective;
      damping *= improved ? 0.2 : 10.0;
      if (improved) {
        gain = estimate.objective - objective;
        residual = candidate_residual;
        estimate = {candidate, objective};
      }
    }
    if (!improved || gain <= 1e-9 * estimate.objective) break;
  }
  return estimate;
}

}  // namespace poselift
