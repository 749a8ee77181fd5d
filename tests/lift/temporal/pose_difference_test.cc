// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/pose_difference.h"

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include "lift/temporal/pose_prediction.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;

SkeletonPose RandomPose(std::mt19937_64* rng) {
  SkeletonPose pose = SkeletonPose::Rest(testing::TrimmedCmuLikeSkeleton());
  pose.dofs = testing::RandomMatrix(kNumAngles, 1, rng);
  pose.root_in_world_m = testing::RandomMatrix(3, 1, rng);
  pose.world_from_root = Eigen::Quaterniond(Eigen::Vector4d(testing::RandomMatrix(4, 1, rng)));
  pose.world_from_root.normalize();
  return pose;
}

TEST(PoseDifference, MovedByIsTheWayBack) {
  auto rng = testing::TestRng();
  for (int i = 0; i < 50; ++i) {
    const SkeletonPose a = RandomPose(&rng), b = RandomPose(&rng);
    const FeatureVector difference = PoseDifference(a, b);
    const SkeletonPose moved = MovedBy(b, difference);
    EXPECT_TRUE(MatrixNear(moved.dofs, a.dofs, 1e-12));
    EXPECT_TRUE(MatrixNear(moved.root_in_world_m, a.root_in_world_m, 1e-12));
    EXPECT_NEAR(moved.world_from_root.angularDistance(a.world_from_root), 0.0, 1e-6);
    EXPECT_TRUE(MatrixNear(PoseDifference(moved, b), difference, 1e-9));
  }
}

TEST(PoseDifference, DoesNotDependOnHeadingAndPlace) {
  auto rng = testing::TestRng();
  SkeletonPose a = RandomPose(&rng), b = RandomPose(&rng);
  const FeatureVector difference = PoseDifference(a, b);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitY()));
  for (SkeletonPose* pose : {&a, &b}) {
    pose->root_in_world_m = turn * pose->root_in_world_m + Eigen::Vector3d(1.0, 2.0, 3.0);
    pose->world_from_root = turn * pose->world_from_root;
  }
  EXPECT_TRUE(MatrixNear(PoseDifference(a, b), difference, 1e-12));
}

TEST(PoseDifference, IsWhatThePredictionCostWeighs) {
  auto rng = testing::TestRng();
  SkeletonPose a = RandomPose(&rng);
  const PosePrediction prediction{RandomPose(&rng),
                                  Eigen::MatrixXd::Identity(kNumFeatures, kNumFeatures)};
  const auto cost = MakePredictionCost(prediction, 1.0);
  const double* blocks[] = {a.root_in_world_m.data(), a.world_from_root.coeffs().data(),
                            a.dofs.data()};
  FeatureVector residuals;
  ASSERT_TRUE(cost->Evaluate(blocks, residuals.data(), nullptr));
  EXPECT_TRUE(MatrixNear(residuals, PoseDifference(a, prediction.pose), 1e-12));
}

}  // namespace
}  // namespace poselift
