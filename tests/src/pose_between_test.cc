// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Two poses of a made-up skeleton with known values between them.
#include "src/pose_between.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Eigen::Vector3d;

TEST(PoseBetweenTest, MixesPlaceRotationAndAngles) {
  const Skeleton skeleton = testing::TrimmedCmuLikeSkeleton();
  SkeletonPose a = SkeletonPose::Rest(skeleton), b = a;
  b.root_in_world_m = {4.0, 0.0, -2.0};
  b.world_from_root = Eigen::AngleAxisd(0.8, Vector3d::UnitY());
  b.dofs[3] = 1.0;
  const SkeletonPose mixed = PoseBetween(skeleton, a, b, 0.25);
  EXPECT_TRUE(testing::MatrixNear(mixed.root_in_world_m, Vector3d(1.0, 0.0, -0.5), 1e-12));
  EXPECT_NEAR(mixed.world_from_root.angularDistance(
                  Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vector3d::UnitY()))),
              0.0, 1e-7);
  EXPECT_NEAR(mixed.dofs[3], 0.25, 1e-12);
  EXPECT_NEAR(mixed.dofs.norm(), 0.25, 1e-12);
}

TEST(PoseBetweenTest, AnglesGoTheShortWayRoundAndShiftsDoNot) {
  Skeleton skeleton = testing::TrimmedCmuLikeSkeleton();
  skeleton.bones.back().dofs = {{Dof::Kind::kRx}, {Dof::Kind::kTx}};
  SkeletonPose a = SkeletonPose::Rest(skeleton), b = a;
  const Eigen::Index rotation = skeleton.NumDofs() - 2, shift = skeleton.NumDofs() - 1;
  a.dofs[rotation] = 3.0;
  b.dofs[rotation] = 3.2 - 2.0 * std::numbers::pi;
  b.dofs[shift] = 8.0;
  const SkeletonPose mixed = PoseBetween(skeleton, a, b, 0.5);
  EXPECT_NEAR(mixed.dofs[rotation], 3.1, 1e-12);
  EXPECT_NEAR(mixed.dofs[shift], 4.0, 1e-12);
}

}  // namespace
}  // namespace poselift
