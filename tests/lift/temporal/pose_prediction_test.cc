// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/pose_prediction.h"

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include "src/dof_angles.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_pose.h"
#include "tests/support/planted_tag.h"
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

SkeletonPose Moved(const SkeletonPose& pose, double size, std::mt19937_64* rng) {
  SkeletonPose moved = pose;
  moved.dofs += size * RandomMatrix(kNumAngles, 1, rng);
  moved.root_in_world_m += size * RandomMatrix(3, 1, rng);
  const Eigen::Vector3d turn = size * RandomMatrix(3, 1, rng);
  moved.world_from_root = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * pose.world_from_root;
  return moved;
}

Eigen::VectorXd Residuals(const ceres::CostFunction& cost, const SkeletonPose& pose,
                          double** jacobians = nullptr) {
  const double* blocks[] = {pose.root_in_world_m.data(), pose.world_from_root.coeffs().data(),
                            pose.dofs.data()};
  Eigen::VectorXd residuals(cost.num_residuals());
  cost.Evaluate(blocks, residuals.data(), jacobians);
  return residuals;
}

// The features of the pose, as if it followed `before`.
FeatureVector FeaturesAfter(const SkeletonPose& before, const SkeletonPose& pose) {
  return MotionFeatures({TrimmedCmuLikeSkeleton(), kFrameTime_s, {before, pose}}).col(1);
}

TEST(PosePrediction, CostIsTheDifferenceOfTheFeatures) {
  auto rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const SkeletonPose before = RandomPoseWithinLimits(TrimmedCmuLikeSkeleton(), 0.3, &rng);
    SkeletonPose mean = Moved(before, 0.02, &rng);
    // To first order tilt and turn add up for a body that is nearly upright.
    mean.world_from_root =
        Eigen::AngleAxisd(0.4 * trial, Eigen::Vector3d::UnitY()) * Eigen::Quaterniond::Identity();
    SkeletonPose same_heading = before;
    same_heading.world_from_root = mean.world_from_root;
    same_heading.root_in_world_m = mean.root_in_world_m;
    const PosePrediction prediction{mean, Eigen::MatrixXd::Identity(kNumFeatures, kNumFeatures)};
    const auto cost = MakePredictionCost(prediction, kFrameTime_s);
    EXPECT_LT(Residuals(*cost, mean).norm(), 1e-12);
    const SkeletonPose pose = Moved(mean, 1e-5, &rng);
    const FeatureVector expected =
        FeaturesAfter(same_heading, pose) - FeaturesAfter(same_heading, mean);
    EXPECT_TRUE(MatrixNear(Residuals(*cost, pose), expected, 1e-6));
  }
}

TEST(PosePrediction, JacobiansEqualDifferences) {
  auto rng = TestRng();
  const SkeletonPose mean = RandomPoseWithinLimits(TrimmedCmuLikeSkeleton(), 0.5, &rng);
  const PosePrediction prediction{mean, RandomMatrix(20, kNumFeatures, &rng)};
  const auto cost = MakePredictionCost(prediction, kFrameTime_s);
  SkeletonPose pose = Moved(mean, 0.3, &rng);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor by_place(20, 3), by_turn(20, 4), by_dofs(20, kNumAngles);
  double* jacobians[] = {by_place.data(), by_turn.data(), by_dofs.data()};
  Residuals(*cost, pose, jacobians);
  const auto expect_column = [&](double& parameter, const Eigen::VectorXd& column) {
    constexpr double kStep = 1e-5;
    const double start = parameter;
    parameter = start + kStep;
    const Eigen::VectorXd ahead = Residuals(*cost, pose);
    parameter = start - kStep;
    const Eigen::VectorXd behind = Residuals(*cost, pose);
    parameter = start;
    EXPECT_TRUE(MatrixNear((ahead - behind) / (2 * kStep), column, 1e-6));
  };
  for (int i = 0; i < 3; ++i) expect_column(pose.root_in_world_m[i], by_place.col(i));
  for (int i = 0; i < 4; ++i) expect_column(pose.world_from_root.coeffs()[i], by_turn.col(i));
  for (int i = 0; i < kNumAngles; ++i) expect_column(pose.dofs[i], by_dofs.col(i));
}

TEST(PosePrediction, TheTwoQuaternionsOfARotationAreOne) {
  auto rng = TestRng();
  const SkeletonPose mean = RandomPoseWithinLimits(TrimmedCmuLikeSkeleton(), 0.5, &rng);
  const PosePrediction prediction{mean, RandomMatrix(5, kNumFeatures, &rng)};
  const auto cost = MakePredictionCost(prediction, kFrameTime_s);
  SkeletonPose pose = Moved(mean, 0.3, &rng);
  const Eigen::VectorXd residuals = Residuals(*cost, pose);
  pose.world_from_root.coeffs() *= -1.0;
  EXPECT_TRUE(MatrixNear(Residuals(*cost, pose), residuals, 1e-12));
}

// From a mean far off that is hardly believed.
SkeletonPose PoseFromTags(const SkeletonPose& truth, const std::vector<std::string>& bones,
                          std::mt19937_64* rng) {
  const Articulation body(TrimmedCmuLikeSkeleton());
  std::vector<ObservedBonePose> tags;
  for (const std::string& bone : bones)
    tags.push_back(testing::PlantTag(body.skeleton, truth, bone));
  const PosePrediction weak{Moved(truth, 0.2, rng),
                            1e-3 * Eigen::MatrixXd::Identity(kNumFeatures, kNumFeatures)};
  return MostProbablePose(body, weak, {}, kFrameTime_s, tags);
}

TEST(PosePrediction, TwoTagsTellTheElbowBetweenThem) {
  auto rng = TestRng();
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  for (int trial = 0; trial < 5; ++trial) {
    SkeletonPose truth = RandomPoseWithinLimits(skeleton, 0.5, &rng);
    SkeletonPose found = PoseFromTags(truth, {"lhumerus", "lradius"}, &rng);
    EXPECT_NEAR(testing::DofOf(skeleton, "lradius", Dof::Kind::kRx, &found),
                testing::DofOf(skeleton, "lradius", Dof::Kind::kRx, &truth), 1e-4);
  }
}

TEST(PosePrediction, OneTagTellsThePlaceAndOrientationOfItsBone) {
  auto rng = TestRng();
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const int bone = *skeleton.FindBone("rtibia");
  BoneFrames in_truth, in_found;
  for (int trial = 0; trial < 5; ++trial) {
    const SkeletonPose truth = RandomPoseWithinLimits(skeleton, 0.5, &rng);
    ForwardKinematics(skeleton, truth, &in_truth);
    ForwardKinematics(skeleton, PoseFromTags(truth, {"rtibia"}, &rng), &in_found);
    EXPECT_LT(AngleBetween(in_truth.world_from_bone[bone], in_found.world_from_bone[bone]), 1e-4);
    EXPECT_TRUE(
        MatrixNear(in_truth.start_in_world_m.col(bone), in_found.start_in_world_m.col(bone), 1e-4));
  }
}

}  // namespace
}  // namespace poselift
