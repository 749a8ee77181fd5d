// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Motions moved between made-up skeletons: the direction rule, dofs that are
// missing, bones without a partner.
#include "src/retarget.h"

#include <gtest/gtest.h>

#include "src/forward_kinematics.h"
#include "src/units.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ExpectSamePlaces;
using testing::MatrixNear;
using testing::RandomMotion;
using testing::TestRng;

const std::vector<Dof> kAllTurns = {{Dof::Kind::kRz}, {Dof::Kind::kRx}, {Dof::Kind::kRy}};

// Two bones; the rest pose of the second has the given direction.
Skeleton Arm(const Eigen::Vector3d& direction, const std::vector<Dof>& dofs) {
  Skeleton skeleton;
  skeleton.bones = {{.name = "root"},
                    {.name = "Upper", .parent = 0, .tip_m = direction, .dofs = kAllTurns},
                    {.name = "Lower",
                     .parent = 1,
                     .offset_m = direction,
                     .tip_m = direction,
                     .rest_from_axis = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()).matrix(),
                     .dofs = dofs}};
  return skeleton;
}

TEST(RebaseMotion, KeepsWhereBonesPointWhateverTheRestPose) {
  auto rng = TestRng();
  const Motion motion = RandomMotion(Arm({0, -1, 0}, kAllTurns), 30, &rng);
  const Skeleton other = Arm({0.6, 0.8, 0}, {{Dof::Kind::kRy}, {Dof::Kind::kRz}, {Dof::Kind::kRx}});
  RebaseReport report;
  const Motion there = RebaseMotion(motion, other, &report);
  ExpectSamePlaces(motion, there, 1e-12);
  EXPECT_EQ(report.num_matched, 2);
  EXPECT_LT(report.worst_rotation_rad, 1e-12);
  const Motion back = RebaseMotion(there, motion.skeleton);
  ExpectSamePlaces(motion, back, 1e-12);
  BoneFrames a, b;
  for (size_t f = 0; f < motion.frames.size(); ++f) {
    ForwardKinematics(motion.skeleton, motion.frames[f], &a);
    ForwardKinematics(back.skeleton, back.frames[f], &b);
    for (int bone = 0; bone < 3; ++bone)
      EXPECT_TRUE(MatrixNear(a.world_from_bone[bone], b.world_from_bone[bone], 1e-12));
  }
}

TEST(RebaseMotion, ReportsWhatTheDofsCannotExpress) {
  Motion motion{Arm({0, -1, 0}, kAllTurns), 0.1, {}};
  motion.skeleton.bones[2].rest_from_axis.setIdentity();
  for (const double angle_deg : {0.0, 25.0, 10.0}) {
    SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
    pose.dofs[3] = angle_deg * kRadFromDeg;  // Lower rz
    motion.frames.push_back(pose);
  }
  Skeleton hinge = motion.skeleton;
  hinge.bones[2].dofs = {{Dof::Kind::kRx}};
  RebaseReport report;
  RebaseMotion(motion, hinge, &report);
  EXPECT_NEAR(report.worst_rotation_rad * kDegFromRad, 25.0, 1e-9);
  EXPECT_EQ(report.worst_bone, "Lower");
  EXPECT_EQ(report.worst_frame, 1);
}

TEST(RebaseMotion, CarriesShiftsAndReportsThoseLost) {
  auto rng = TestRng();
  Skeleton sliding = Arm({0, -1, 0}, {{Dof::Kind::kTx}, {Dof::Kind::kRx}, {Dof::Kind::kTz}});
  const Motion motion = RandomMotion(sliding, 10, &rng);
  Skeleton target = Arm({1, 0, 0}, kAllTurns);
  for (const Dof::Kind kind : {Dof::Kind::kTz, Dof::Kind::kTy, Dof::Kind::kTx})
    target.bones[2].dofs.push_back({kind});
  RebaseReport report;
  ExpectSamePlaces(motion, RebaseMotion(motion, target, &report), 1e-12);
  EXPECT_LT(report.worst_shift_m, 1e-12);
  RebaseMotion(motion, Arm({1, 0, 0}, kAllTurns), &report);
  EXPECT_GT(report.worst_shift_m, 0.1);
}

TEST(RebaseMotion, LeavesBonesWithoutAPartnerAtRest) {
  auto rng = TestRng();
  const Motion motion = RandomMotion(Arm({0, -1, 0}, kAllTurns), 5, &rng);
  Skeleton target = Arm({0, -1, 0}, kAllTurns);
  target.bones[2].name = "Tail";
  RebaseReport report;
  const Motion rebased = RebaseMotion(motion, target, &report);
  ASSERT_EQ(report.bones_at_rest.size(), 1u);
  EXPECT_EQ(report.bones_at_rest[0], "Tail");
  for (const SkeletonPose& pose : rebased.frames) EXPECT_TRUE(pose.dofs.tail(3).isZero());
}

}  // namespace
}  // namespace poselift
