// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/proportions_cost.h"

#include <ceres/cost_function.h>

#include <cmath>
#include <utility>

#include "lift/body_proportions.h"
#include "src/forward_kinematics.h"

namespace poselift {
namespace {

class ProportionsCost final : public ceres::CostFunction {
 public:
  ProportionsCost(const Articulation& standard, std::vector<TargetPoint> points)
      : standard_(standard),
        points_(points),
        body_(standard),
        reprojection_(MakeReprojectionCost(body_, std::move(points))) {
    set_num_residuals(reprojection_->num_residuals());
    *mutable_parameter_block_sizes() = reprojection_->parameter_block_sizes();
    mutable_parameter_block_sizes()->push_back(kNumBoneGroups);
    pose_.dofs.setZero(standard.num_dofs);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    SetProportions(standard_.skeleton, Eigen::Map<const GroupVector>(parameters[4]),
                   &body_.skeleton);
    if (!reprojection_->Evaluate(parameters, residuals, jacobians)) return false;
    if (jacobians && jacobians[4]) DifferentiateByRatios(parameters, jacobians[4]);
    return true;
  }

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kNumBoneGroups, Eigen::RowMajor>;

  // A joint is the sum of the bones that lead to it, and each bone its own
  // derivative by the logarithm of its length.
  void DifferentiateByRatios(double const* const* parameters, double* by_ratios) const {
    pose_.root_in_world_m = Eigen::Map<const Eigen::Vector3d>(parameters[0]);
    pose_.world_from_root.coeffs() = Eigen::Map<const Eigen::Vector4d>(parameters[1]);
    pose_.dofs = Eigen::Map<const Eigen::VectorXd>(parameters[2], standard_.num_dofs);
    ForwardKinematics(body_.skeleton, pose_, &frames_);
    const double scale_px_per_m = std::exp(parameters[3][0]);
    Eigen::Map<Rows> rows(by_ratios, num_residuals(), kNumBoneGroups);
    rows.setZero();
    for (size_t i = 0; i < points_.size(); ++i)
      for (const Landmark::Part& part : points_[i].parts) {
        const double factor = points_[i].root_weight * scale_px_per_m * part.weight;
        for (int j = part.joint; j > 0; j = Joints()[j].parent)
          rows.block<2, 1>(2 * static_cast<Eigen::Index>(i), GroupOfJoint(j)) +=
              factor * (frames_.tip_in_world_m.col(j) - frames_.start_in_world_m.col(j)).head<2>();
      }
  }

  const Articulation& standard_;
  const std::vector<TargetPoint> points_;
  // Of the latest evaluation.
  mutable Articulation body_;
  mutable SkeletonPose pose_;
  mutable BoneFrames frames_;
  std::unique_ptr<ceres::CostFunction> reprojection_;  // of body_
};

}  // namespace

std::unique_ptr<ceres::CostFunction> MakeProportionsCost(const Articulation& standard,
                                                         std::vector<TargetPoint> points) {
  return std::make_unique<ProportionsCost>(standard, std::move(points));
}

}  // namespace poselift
