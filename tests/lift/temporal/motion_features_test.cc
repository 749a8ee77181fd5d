// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up motions that visit all rotations, and real ones where they are: there
// and back, what features do not depend on, hand-made frames with known features.
#include "lift/temporal/motion_features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lift/temporal/motion_database.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::MatrixNear;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

constexpr double kPi = std::numbers::pi;

Quaterniond AboutY(double angle_rad) {
  return Quaterniond(AngleAxisd(angle_rad, Vector3d::UnitY()));
}

// The features alone, from the first pose on, lead through the whole motion.
void ExpectFeaturesLeadBack(const Motion& motion) {
  const FeatureMatrix features = MotionFeatures(motion);
  ASSERT_EQ(features.cols(), static_cast<Eigen::Index>(motion.frames.size()));
  ASSERT_TRUE(features.allFinite());
  SkeletonPose pose = motion.frames[0];
  for (Eigen::Index t = 1; t < features.cols(); ++t) {
    const SkeletonPose& truth = motion.frames[t];
    pose = PoseFromFeatures(features.col(t), pose, motion.frame_time_s);
    ASSERT_TRUE(MatrixNear(pose.root_in_world_m, truth.root_in_world_m, 1e-9)) << t;
    ASSERT_TRUE(MatrixNear(pose.world_from_root.toRotationMatrix(),
                           truth.world_from_root.toRotationMatrix(), 1e-9))
        << t;
    for (int d = 0; d < kNumAngles; ++d)
      ASSERT_NEAR(std::remainder(pose.dofs[d] - truth.dofs[d], 2.0 * kPi), 0.0, 1e-9) << t;
  }
}

TEST(MotionFeatures, LeadBackToTheMotion) {
  auto rng = TestRng();
  for (int i = 0; i < 20; ++i)
    ExpectFeaturesLeadBack(testing::RandomMotion(TrimmedCmuLikeSkeleton(), 100, &rng));
  Motion jumps = testing::RandomMotion(TrimmedCmuLikeSkeleton(), 500, &rng);
  for (SkeletonPose& pose : jumps.frames)
    pose = testing::RandomPoseWithinLimits(jumps.skeleton, 1.0, &rng);
  ExpectFeaturesLeadBack(jumps);
}

TEST(MotionFeatures, LeadBackFromUpsideDown) {
  Motion motion{TrimmedCmuLikeSkeleton(), 0.1, {}};
  for (int f = 0; f <= 8; ++f) {  // a cartwheel, half way exactly upside down
    SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
    pose.world_from_root = AboutY(0.4) * AngleAxisd(0.25 * kPi * f, Vector3d::UnitZ());
    pose.root_in_world_m = {-0.1 * f, 1.0, 0.0};
    motion.frames.push_back(pose);
  }
  motion.frames[4].world_from_root = {0.0, 0.6, 0.0, 0.8};
  ExpectFeaturesLeadBack(motion);
  EXPECT_NEAR(MotionFeatures(motion).col(4).segment<2>(feature::kTilt).norm(), kPi, 1e-12);
}

TEST(MotionFeatures, OfTheFirstFrameHaveTheVelocityOfTheSecond) {
  auto rng = TestRng();
  const FeatureMatrix features =
      MotionFeatures(testing::RandomMotion(TrimmedCmuLikeSkeleton(), 3, &rng));
  EXPECT_EQ(features.col(0).tail<3>(), features.col(1).tail<3>());
  EXPECT_NE(features.col(0).tail<3>(), features.col(2).tail<3>());
  Motion still = testing::RandomMotion(TrimmedCmuLikeSkeleton(), 1, &rng);
  EXPECT_TRUE(MotionFeatures(still).col(0).tail<3>().isZero(0.0));
  still.frames.clear();
  EXPECT_EQ(MotionFeatures(still).cols(), 0);
}

TEST(MotionFeatures, DoNotDependOnPlaceAndHeading) {
  auto rng = TestRng();
  const Motion motion = testing::RandomMotion(TrimmedCmuLikeSkeleton(), 200, &rng);
  Motion moved = motion;
  for (SkeletonPose& pose : moved.frames) {
    pose.root_in_world_m = AboutY(2.2) * pose.root_in_world_m + Vector3d(3.0, 0.0, -40.0);
    pose.world_from_root = AboutY(2.2) * pose.world_from_root;
    pose.world_from_root.coeffs() *= -1.0;  // the same rotation
  }
  EXPECT_TRUE(MatrixNear(MotionFeatures(moved), MotionFeatures(motion), 1e-9));
}

TEST(MotionFeatures, TellHeightTiltVelocityAndYawRate) {
  Motion motion{TrimmedCmuLikeSkeleton(), 0.5, {}};
  SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
  pose.root_in_world_m = {1.0, 0.9, 2.0};
  pose.world_from_root = AboutY(kPi - 0.1);
  motion.frames.push_back(pose);
  // Half a turn from the front, heading for -z, with the left at -x.
  pose.root_in_world_m += Vector3d(-0.3, 0.1, -0.7);
  pose.world_from_root = AboutY(-kPi) * AngleAxisd(0.5, Vector3d(0.6, 0.0, 0.8));
  motion.frames.push_back(pose);
  const FeatureMatrix features = MotionFeatures(motion);
  Eigen::Matrix<double, 6, 1> wanted;
  wanted << 1.0, 0.3, 0.4, 0.6, 1.4, 0.2;
  EXPECT_TRUE(MatrixNear(features.col(1).tail<6>(), wanted, 1e-12));
  EXPECT_NEAR(features(feature::kHeight, 0), 0.9, 1e-12);
}

TEST(MotionFeatures, UnwrapAngles) {
  Motion motion{TrimmedCmuLikeSkeleton(), 0.1, {}};
  for (int f = 0; f < 100; ++f) {
    SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
    pose.dofs[7] = std::remainder(1.0 + 0.3 * f, 2.0 * kPi);
    pose.dofs[30] = std::remainder(-0.2 * f, 2.0 * kPi);
    motion.frames.push_back(pose);
  }
  const FeatureMatrix features = MotionFeatures(motion);
  for (int f = 0; f < 100; ++f) {
    EXPECT_NEAR(features(7, f), 1.0 + 0.3 * f, 1e-10);
    EXPECT_NEAR(features(30, f), -0.2 * f, 1e-10);
  }
}

TEST(MotionFeatures, OfTheMirroredMotionAreMirrored) {
  auto rng = TestRng();
  const Motion motion = testing::RandomMotion(TrimmedCmuLikeSkeleton(), 50, &rng);
  Motion mirrored = motion;
  for (SkeletonPose& pose : mirrored.frames) pose = testing::MirroredPose(motion.skeleton, pose);
  const FeatureMatrix features = MotionFeatures(motion);
  EXPECT_TRUE(
      MatrixNear(MirroredFeatures(features, motion.skeleton), MotionFeatures(mirrored), 1e-9));
}

TEST(MotionFeatures, RefuseOtherSkeletons) {
  auto rng = TestRng();
  EXPECT_THROW(MotionFeatures(testing::RandomMotion(testing::CmuLikeSkeleton(), 3, &rng)),
               InputError);
  Skeleton sliding = TrimmedCmuLikeSkeleton();
  sliding.bones[2].dofs[0].kind = Dof::Kind::kTx;
  EXPECT_THROW(MotionFeatures(testing::RandomMotion(sliding, 3, &rng)), InputError);
  Motion timeless = testing::RandomMotion(TrimmedCmuLikeSkeleton(), 3, &rng);
  timeless.frame_time_s = 0.0;
  EXPECT_THROW(MotionFeatures(timeless), InputError);
}

TEST(MotionFeatures, LeadBackToRealMotions) {
  POSELIFT_DATA_OR_SKIP(data);
  for (const char* trial : {"01/01_01", "49/49_08", "09/09_03"}) {
    const std::filesystem::path amc = data / "mocap/cmu" / (std::string(trial) + ".amc");
    const AsfSkeleton asf = ReadAsfSkeleton(FindAsfOf(amc));
    const Motion motion =
        OnStandardSkeleton(ReadAmc(amc, asf), TrimToJoints(asf.skeleton), 1.0 / 60.0);
    ExpectFeaturesLeadBack(motion);
  }
}

}  // namespace
}  // namespace poselift
