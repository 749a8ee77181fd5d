// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/pose_prediction.h"

#include <ceres/cost_function.h>

#include "lift/ik/pose_problem.h"

namespace poselift {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kFunctionTolerance = 1e-5;

using RowMajorMap =
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
using Quaternion = Eigen::Quaterniond;

// vec(q conj(mean)) = M q, with q's coefficients x y z w.
Eigen::Matrix<double, 3, 4> VectorOfProduct(const Quaternion& mean) {
  Eigen::Matrix<double, 3, 4> m;
  m << mean.w(), -mean.z(), mean.y(), -mean.x(),  //
      mean.z(), mean.w(), -mean.x(), -mean.y(),   //
      -mean.y(), mean.x(), mean.w(), -mean.z();
  return m;
}

class PredictionCost final : public ceres::CostFunction {
 public:
  PredictionCost(const PosePrediction& prediction, double frame_time_s) : mean_(prediction.pose) {
    const Eigen::MatrixXd& w = prediction.whitening;
    const Eigen::Matrix3d world_from_heading =
        Eigen::AngleAxisd(Yaw(mean_.world_from_root), Eigen::Vector3d::UnitY()).toRotationMatrix();
    Eigen::MatrixXd place(w.rows(), 3), turn(w.rows(), 3);
    place << w.col(feature::kVelocity) / frame_time_s, w.col(feature::kHeight),
        w.col(feature::kVelocity + 1) / frame_time_s;
    turn << w.col(feature::kTilt), w.col(feature::kYawRate) / frame_time_s,
        w.col(feature::kTilt + 1);
    by_place_ = place * world_from_heading.transpose();
    by_turn_ = 2.0 * turn * world_from_heading.transpose() * VectorOfProduct(mean_.world_from_root);
    by_dofs_ = w.leftCols(kNumAngles);
    set_num_residuals(static_cast<int>(w.rows()));
    *mutable_parameter_block_sizes() = {3, 4, kNumAngles};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> place_m(parameters[0]);
    const Eigen::Map<const Eigen::Vector4d> turn(parameters[1]);
    const Eigen::Map<const Eigen::VectorXd> dofs(parameters[2], kNumAngles);
    // q and -q are one rotation: the one on the mean's side is meant.
    const double side = turn.dot(mean_.world_from_root.coeffs()) < 0.0 ? -1.0 : 1.0;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) =
        by_place_ * (place_m - mean_.root_in_world_m) + side * (by_turn_ * turn) +
        by_dofs_ * (dofs - mean_.dofs);
    if (!jacobians) return true;
    if (jacobians[0]) RowMajorMap(jacobians[0], num_residuals(), 3) = by_place_;
    if (jacobians[1]) RowMajorMap(jacobians[1], num_residuals(), 4) = side * by_turn_;
    if (jacobians[2]) RowMajorMap(jacobians[2], num_residuals(), kNumAngles) = by_dofs_;
    return true;
  }

 private:
  SkeletonPose mean_;
  Eigen::MatrixXd by_place_, by_turn_, by_dofs_;  // the residuals are linear in these
};

}  // namespace

std::unique_ptr<ceres::CostFunction> MakePredictionCost(const PosePrediction& prediction,
                                                        double frame_time_s) {
  return std::make_unique<PredictionCost>(prediction, frame_time_s);
}

SkeletonPose MostProbablePose(const Articulation& body, const PosePrediction& prediction,
                              const std::vector<TargetPoint>& observed, double frame_time_s,
                              const std::vector<ObservedBonePose>& bone_poses) {
  const DofLimits none(body, /*enforce=*/false);
  PoseProblem problem(body, prediction.pose,
                      {.limits = none, .rest = Eigen::VectorXd::Zero(body.num_dofs)});
  problem.AddPoseTerm(MakePredictionCost(prediction, frame_time_s));
  if (!observed.empty() || !bone_poses.empty())
    problem.AddPoseTerm(MakeSpaceCost(body, observed, false, bone_poses));
  const bool solved = IsUsable(problem.Solve(kMaxIterations, kFunctionTolerance).status);
  return solved ? problem.pose() : prediction.pose;
}

}  // namespace poselift
