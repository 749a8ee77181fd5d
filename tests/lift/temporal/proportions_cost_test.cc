// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Random poses of the made-up skeleton; derivatives against central differences.
#include "lift/temporal/proportions_cost.h"

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include "lift/body_proportions.h"
#include "src/layout.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

std::vector<TargetPoint> Targets() {
  std::vector<TargetPoint> points;
  for (const Landmark& landmark : FindLayout("body15")->landmarks)
    points.push_back({landmark.parts, Eigen::Vector3d(300.0, 200.0, 0.0), 0.2});
  return points;
}

class ProportionsCostTest : public ::testing::Test {
 protected:
  ProportionsCostTest() : body_(testing::TrimmedCmuLikeSkeleton()) {
    auto rng = testing::TestRng();
    std::normal_distribution<double> normal(0.0, 0.3);
    pose_ = SkeletonPose::Rest(body_.skeleton);
    for (double& dof : pose_.dofs) dof = normal(rng);
    for (double& ratio : ratios_) ratio = 0.3 * normal(rng);
    pose_.world_from_root = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 0.5).normalized());
  }

  Eigen::VectorXd Residuals(const ceres::CostFunction& cost, const GroupVector& ratios,
                            double* by_ratios) const {
    const double* blocks[] = {pose_.root_in_world_m.data(), pose_.world_from_root.coeffs().data(),
                              pose_.dofs.data(), camera_.data(), ratios.data()};
    double* jacobians[] = {nullptr, nullptr, nullptr, nullptr, by_ratios};
    Eigen::VectorXd residuals(cost.num_residuals());
    EXPECT_TRUE(cost.Evaluate(blocks, residuals.data(), by_ratios ? jacobians : nullptr));
    return residuals;
  }

  Articulation body_;
  SkeletonPose pose_;
  GroupVector ratios_;
  Eigen::Vector3d camera_{5.0, 310.0, 220.0};
};

TEST_F(ProportionsCostTest, SeesTheBodyOfTheseProportions) {
  const Articulation own(WithProportions(body_.skeleton, ratios_));
  const auto cost = MakeProportionsCost(body_, Targets());
  const auto plain = MakeReprojectionCost(own, Targets());
  EXPECT_TRUE(testing::MatrixNear(Residuals(*cost, ratios_, nullptr),
                                  Residuals(*plain, ratios_, nullptr), 1e-9));
}

TEST_F(ProportionsCostTest, DerivativesAreThoseOfDifferences) {
  const auto cost = MakeProportionsCost(body_, Targets());
  Eigen::Matrix<double, Eigen::Dynamic, kNumBoneGroups, Eigen::RowMajor> analytic(
      cost->num_residuals(), kNumBoneGroups);
  Residuals(*cost, ratios_, analytic.data());
  constexpr double kStep = 1e-5;
  for (int g = 0; g < kNumBoneGroups; ++g) {
    const GroupVector step = kStep * GroupVector::Unit(g);
    const Eigen::VectorXd difference =
        (Residuals(*cost, ratios_ + step, nullptr) - Residuals(*cost, ratios_ - step, nullptr)) /
        (2.0 * kStep);
    EXPECT_TRUE(testing::MatrixNear(analytic.col(g), difference, 1e-6)) << g;
  }
}

}  // namespace
}  // namespace poselift
