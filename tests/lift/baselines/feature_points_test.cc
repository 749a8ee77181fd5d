// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up skeleton, random features and random points of the body.
#include "lift/baselines/feature_points.h"

#include <gtest/gtest.h>

#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_pose.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::RandomPoseWithinLimits;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

constexpr double kFrameTime_s = 1.0 / 60.0;

struct Scene {
  Scene() : rng(TestRng()), body(TrimmedCmuLikeSkeleton()), points(body, kFrameTime_s) {
    before = RandomPoseWithinLimits(body.skeleton, 0.5, &rng);
    features = 0.4 * RandomMatrix(kNumFeatures, 1, &rng);
    // The last three are speeds: as large as makes a step of the others' size.
    features.tail<3>() /= kFrameTime_s;
  }

  std::vector<TargetPoint> Targets(const SkeletonPose& pose) const {
    const Pose3 joints_m = JointPositions(body, pose);
    std::vector<TargetPoint> targets;
    targets.push_back({{{joint::kLeftHand, 1.0}}, joints_m.col(joint::kLeftHand), 3.0});
    targets.push_back({{{joint::kLeftAnkle, 0.5}, {joint::kRightAnkle, 0.5}},
                       0.5 * (joints_m.col(joint::kLeftAnkle) + joints_m.col(joint::kRightAnkle)),
                       20.0});
    return targets;
  }

  std::mt19937_64 rng;
  Articulation body;
  FeaturePoints points;
  SkeletonPose before;
  FeatureVector features;
};

TEST(FeaturePoints, AreWhereTheFeaturesPoseHasThem) {
  Scene scene;
  std::vector<TargetPoint> targets =
      scene.Targets(PoseFromFeatures(scene.features, scene.before, kFrameTime_s));
  scene.points.Observe(scene.before, targets);
  ASSERT_EQ(scene.points.num_rows(), 6);
  Eigen::VectorXd residuals(6);
  scene.points.Evaluate(scene.features, residuals, nullptr);
  EXPECT_LT(residuals.norm(), 1e-12);
  targets[1].x.y() -= 0.1;
  scene.points.Observe(scene.before, targets);
  scene.points.Evaluate(scene.features, residuals, nullptr);
  EXPECT_NEAR(residuals[4], 2.0, 1e-12);
  EXPECT_NEAR(scene.points.SquaredMisses_m2(scene.features), 0.01, 1e-12);
}

TEST(FeaturePoints, JacobianEqualsDifferences) {
  Scene scene;
  scene.points.Observe(scene.before, scene.Targets(scene.before));
  // A tilt of none, of little and of much.
  for (const double tilt : {0.0, 1e-7, 1.0}) {
    FeatureVector y = scene.features;
    y.segment<2>(feature::kTilt) *= tilt;
    Eigen::VectorXd residuals(6), ahead(6), behind(6);
    Eigen::MatrixXd by_features;
    scene.points.Evaluate(y, residuals, &by_features);
    for (int d = 0; d < kNumFeatures; ++d) {
      constexpr double kStep = 1e-5;
      const FeatureVector step = kStep * FeatureVector::Unit(d);
      scene.points.Evaluate(y + step, ahead, nullptr);
      scene.points.Evaluate(y - step, behind, nullptr);
      EXPECT_TRUE(MatrixNear((ahead - behind) / (2 * kStep), by_features.col(d), 1e-6)) << d;
    }
  }
}

}  // namespace
}  // namespace poselift
