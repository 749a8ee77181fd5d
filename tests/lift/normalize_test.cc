// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Random joint clouds and lengths: every bone of its length and direction. And
// what Algorithm 1 does as printed.
#include "lift/normalize.h"

#include <gtest/gtest.h>

#include "lift/rotation.h"
#include "src/forward_kinematics.h"
#include "tests/support/planted_pose.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;

Eigen::VectorXd RandomLengths(std::mt19937_64* rng) {
  return (RandomMatrix(kNumJoints, 1, rng).cwiseAbs().array() + 0.05).matrix();
}

// The bone that ends at each joint but the pelvis: 3 x 22.
Eigen::Matrix3Xd Bones(const Pose3& pose) {
  Eigen::Matrix3Xd bones(3, kNumJoints - 1);
  for (int j = 1; j < kNumJoints; ++j)
    bones.col(j - 1) = pose.col(j) - pose.col(Joints()[j].parent);
  return bones;
}

TEST(Normalize, BonesKeepTheirDirectionsAndGetTheirLengths) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 50; ++trial) {
    const Pose3 pose = 300.0 * RandomMatrix(3, kNumJoints, &rng);
    const Eigen::VectorXd lengths = RandomLengths(&rng);
    const Pose3 normalized = NormalizePose(pose, lengths);
    EXPECT_TRUE(MatrixNear(Bones(normalized).colwise().norm().transpose(),
                           lengths.tail(kNumJoints - 1), 1e-11));
    EXPECT_TRUE(MatrixNear(Bones(normalized).colwise().normalized(),
                           Bones(pose).colwise().normalized(), 1e-10));
    EXPECT_EQ(normalized.col(joint::kPelvis), pose.col(joint::kPelvis));
  }
}

TEST(Normalize, IsIdempotent) {
  std::mt19937_64 rng = TestRng();
  const Eigen::VectorXd lengths = RandomLengths(&rng);
  const Pose3 once = NormalizePose(RandomMatrix(3, kNumJoints, &rng), lengths);
  EXPECT_TRUE(MatrixNear(NormalizePose(once, lengths), once, 1e-13));
}

TEST(Normalize, CommutesWithRotationAndIgnoresSize) {
  std::mt19937_64 rng = TestRng();
  const Eigen::VectorXd lengths = RandomLengths(&rng);
  Pose3 pose = RandomMatrix(3, kNumJoints, &rng);
  pose.col(joint::kPelvis).setZero();
  const Eigen::Matrix3d R = CamFromBody({0.3, 2.0, -0.4});
  const Pose3 normalized = NormalizePose(pose, lengths);
  EXPECT_TRUE(MatrixNear(NormalizePose(R * pose, lengths), R * normalized, 1e-12));
  EXPECT_TRUE(MatrixNear(NormalizePose(1000.0 * pose, lengths), normalized, 1e-12));
}

TEST(Normalize, ABoneOfNoLengthTakesTheDirectionBeforeIt) {
  std::mt19937_64 rng = TestRng();
  const Eigen::VectorXd lengths = RandomLengths(&rng);
  Pose3 pose = RandomMatrix(3, kNumJoints, &rng);
  pose.col(joint::kLeftAnkle) = pose.col(joint::kLeftKnee);
  pose.col(joint::kRightHip) = pose.col(joint::kPelvis);
  const Eigen::Matrix3Xd bones = Bones(NormalizePose(pose, lengths));
  EXPECT_TRUE(MatrixNear(bones.col(joint::kLeftAnkle - 1).normalized(),
                         bones.col(joint::kLeftKnee - 1).normalized(), 1e-12));
  EXPECT_TRUE(MatrixNear(bones.col(joint::kRightHip - 1),
                         lengths[joint::kRightHip] * Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(MatrixNear(bones.colwise().norm().transpose(), lengths.tail(22), 1e-12));
}

TEST(Normalize, AllJointsInOnePlaceGiveABodyOfTheRightLengths) {
  std::mt19937_64 rng = TestRng();
  const Eigen::VectorXd lengths = RandomLengths(&rng);
  const Pose3 normalized = NormalizePose(Pose3::Ones(3, kNumJoints), lengths);
  EXPECT_TRUE(MatrixNear(Bones(normalized).colwise().norm().transpose(), lengths.tail(22), 1e-12));
}

TEST(Normalize, APoseOfTheSkeletonIsLeftAsItIs) {
  const Skeleton skeleton = testing::SmallSkeleton();
  SkeletonPose pose = SkeletonPose::Rest(skeleton);
  pose.dofs.setConstant(0.3);
  const Pose3 joints = JointPositions(skeleton, pose);
  EXPECT_TRUE(MatrixNear(NormalizePose(joints, BoneLengths(skeleton)), joints, 1e-13));
}

// y~(k) = dy(k-1) + direction L: the parent's position y(k-1) is missing, so a
// bone has its length only where the parent is at the origin.
TEST(Normalize, Algorithm1AsPrintedGivesWrongLengths) {
  std::mt19937_64 rng = TestRng();
  const Eigen::VectorXd lengths = RandomLengths(&rng);
  Pose3 pose = RandomMatrix(3, kNumJoints, &rng);
  pose.col(joint::kPelvis).setZero();
  Pose3 printed = pose;
  Pose3 shift = Pose3::Zero(3, kNumJoints);
  for (const std::span<const int> chain : JointChains())
    for (size_t i = 1; i < chain.size(); ++i) {
      const int k = chain[i], parent = chain[i - 1];
      printed.col(k) =
          shift.col(parent) + (pose.col(k) - pose.col(parent)).normalized() * lengths[k];
      shift.col(k) = printed.col(k) - pose.col(k);
    }
  const Eigen::VectorXd errors =
      (Bones(printed).colwise().norm().transpose() - lengths.tail(22)).cwiseAbs();
  for (int j = 1; j < kNumJoints; ++j) {
    if (Joints()[j].parent == joint::kPelvis) {
      EXPECT_LT(errors[j - 1], 1e-12);
    } else {
      EXPECT_GT(errors[j - 1], 1e-3);
    }
  }
}

TEST(BoneLengths, AreThoseOfTheSkeletonAtRest) {
  const Eigen::VectorXd lengths = BoneLengths(testing::SmallSkeleton());
  ASSERT_EQ(lengths.size(), kNumJoints);
  EXPECT_EQ(lengths[joint::kPelvis], 0.0);
  for (int j = 1; j < kNumJoints; ++j) {
    EXPECT_GT(lengths[j], 0.0);
    EXPECT_NEAR(lengths[j], lengths[Joints()[j].mirror], 1e-12);
  }
  EXPECT_NEAR(lengths[joint::kLeftElbow], 0.28, 1e-12);
}

}  // namespace
}  // namespace poselift
