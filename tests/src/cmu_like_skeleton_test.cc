// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The made-up skeleton of the tests: what others rely on.
#include "tests/support/cmu_like_skeleton.h"

#include <gtest/gtest.h>

#include "src/forward_kinematics.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::CmuLikeSkeleton;
using testing::MatrixNear;
using testing::TrimmedCmuLikeSkeleton;

SkeletonPose RandomPose(const Skeleton& skeleton, std::mt19937_64* rng) {
  std::normal_distribution<double> normal(0.0, 0.6);
  SkeletonPose pose = SkeletonPose::Rest(skeleton);
  for (double& value : pose.dofs) value = normal(*rng);
  pose.root_in_world_m << normal(*rng), normal(*rng), normal(*rng);
  pose.world_from_root =
      Eigen::Quaterniond(normal(*rng), normal(*rng), normal(*rng), normal(*rng)).normalized();
  return pose;
}

TEST(CmuLikeSkeleton, HasTheBonesAndDofsOfTheCmuFiles) {
  EXPECT_EQ(CmuLikeSkeleton().bones.size(), 31u);
  EXPECT_EQ(CmuLikeSkeleton().NumDofs(), 56);
  EXPECT_EQ(TrimmedCmuLikeSkeleton().NumDofs(), 40);
}

TEST(CmuLikeSkeleton, IsMirrorSymmetricAtRest) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const Pose3 rest = JointPositions(skeleton, SkeletonPose::Rest(skeleton));
  EXPECT_TRUE(MatrixNear(rest, MirroredInBody(rest), 1e-12));
}

TEST(CmuLikeSkeleton, MirroredPoseHasMirroredJoints) {
  auto rng = testing::TestRng();
  const Skeleton skeleton = CmuLikeSkeleton();
  const SkeletonPose pose = RandomPose(skeleton, &rng);
  const Pose3 joints = JointPositions(skeleton, pose);
  const Pose3 of_mirrored = JointPositions(skeleton, testing::MirroredPose(skeleton, pose));
  EXPECT_TRUE(MatrixNear(of_mirrored, MirroredInBody(joints), 1e-12));
}

}  // namespace
}  // namespace poselift
