// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up motions put on the body of 23 joints and changes of them carried back.
// The properties: what RebaseMotion does for CMU skeletons; bones point the same
// way on a rig; nothing changed comes back as it was; a change comes back whole.
#include "src/body_transfer.h"

#include <gtest/gtest.h>

#include "src/dof_angles.h"
#include "src/input_error.h"
#include "src/retarget.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_walk.h"
#include "tests/support/rig_skeleton.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::OnRig;

Motion Walk() { return testing::PlantWalk(60, 0.6, 0.0).motion; }

void ExpectSameFrames(const Motion& a, const Motion& b, double tolerance) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (size_t t = 0; t < a.frames.size(); ++t) {
    EXPECT_TRUE(MatrixNear(a.frames[t].dofs, b.frames[t].dofs, tolerance)) << t;
    EXPECT_TRUE(MatrixNear(a.frames[t].root_in_world_m, b.frames[t].root_in_world_m, tolerance));
    EXPECT_LT(AngleBetween(a.frames[t].world_from_root.toRotationMatrix(),
                           b.frames[t].world_from_root.toRotationMatrix()),
              tolerance);
  }
}

TEST(BodyTransfer, IsRebasingForACmuSkeleton) {
  const Skeleton body = testing::TrimmedCmuLikeSkeleton();
  const Motion whole = RebaseMotion(Walk(), testing::CmuLikeSkeleton());
  const Motion on_body = BodyTransfer(whole.skeleton, body).ToBody(whole);
  ExpectSameFrames(on_body, RebaseMotion(whole, body), 1e-9);
}

TEST(BodyTransfer, ARigsLimbsPointAsTheBodysDo) {
  const Motion walk = Walk();
  const Motion rig = OnRig(walk);
  const Eigen::Matrix3d A = FindBody(rig.skeleton).body_from_source;
  const std::pair<const char*, int> limbs[] = {{"rig:LeftUpLeg", joint::kLeftKnee},
                                               {"rig:RightLeg", joint::kRightAnkle},
                                               {"rig:RightArm", joint::kRightElbow},
                                               {"rig:LeftForeArm", joint::kLeftWrist}};
  BoneFrames of_rig, of_body;
  for (size_t t = 0; t < walk.frames.size(); ++t) {
    ForwardKinematics(rig.skeleton, rig.frames[t], &of_rig);
    ForwardKinematics(walk.skeleton, walk.frames[t], &of_body);
    for (const auto& [name, joint] : limbs) {
      const int bone = *rig.skeleton.FindBone(name);
      EXPECT_TRUE(MatrixNear(
          A * of_rig.world_from_bone[bone] * rig.skeleton.bones[bone].tip_m.normalized(),
          of_body.world_from_bone[joint] * walk.skeleton.bones[joint].tip_m.normalized(), 1e-9));
    }
    // The hips move by their shifts; the root above them does not.
    EXPECT_EQ(rig.frames[t].root_in_world_m, Eigen::Vector3d::Zero());
  }
  // Pelvis and legs have all that the body had; its feet have less than the rig's.
  const Motion back = BodyTransfer(rig.skeleton, walk.skeleton).ToBody(rig);
  for (size_t t = 0; t < walk.frames.size(); ++t) {
    EXPECT_TRUE(MatrixNear(back.frames[t].root_in_world_m, walk.frames[t].root_in_world_m, 1e-9));
    for (const int leg : {0, 6})
      EXPECT_TRUE(MatrixNear(back.frames[t].dofs.segment<4>(leg),
                             walk.frames[t].dofs.segment<4>(leg), 1e-9));
  }
}

TEST(BodyTransfer, NothingChangedComesBackAsItWas) {
  const Motion rig = OnRig(Walk());
  const BodyTransfer transfer(rig.skeleton, testing::TrimmedCmuLikeSkeleton());
  ExpectSameFrames(transfer.CarryBack(rig, transfer.ToBody(rig)), rig, 1e-9);
}

TEST(BodyTransfer, AChangeComesBackWholeAndFingersKeepTheirAngles) {
  const Motion rig = OnRig(Walk());
  const Skeleton body = testing::TrimmedCmuLikeSkeleton();
  const BodyTransfer transfer(rig.skeleton, body);
  Motion after = transfer.ToBody(rig);
  for (SkeletonPose& pose : after.frames) {
    testing::DofOf(body, "ltibia", Dof::Kind::kRx, &pose) += 0.3;
    testing::DofOf(body, "rhumerus", Dof::Kind::kRz, &pose) -= 0.2;
    pose.root_in_world_m.y() += 0.1;
  }
  const Motion carried = transfer.CarryBack(rig, after);
  ExpectSameFrames(transfer.ToBody(carried), after, 1e-9);
  const std::vector<int> first_dof = rig.skeleton.DofStarts();
  for (const char* name : {"rig:LeftHandIndex1", "rig:RightHandThumb1", "rig:LeftShoulder"}) {
    const int bone = *rig.skeleton.FindBone(name);
    const auto num_dofs = static_cast<Eigen::Index>(rig.skeleton.bones[bone].dofs.size());
    for (size_t t = 0; t < rig.frames.size(); ++t)
      EXPECT_EQ(carried.frames[t].dofs.segment(first_dof[bone], num_dofs),
                rig.frames[t].dofs.segment(first_dof[bone], num_dofs));
  }
}

TEST(BodyTransfer, TheUnitOfTheSourceDoesNotMatter) {
  const Motion walk = Walk();
  const Motion in_m = OnRig(walk), in_cm = OnRig(walk, 100.0);
  ExpectSameFrames(BodyTransfer(in_m.skeleton, walk.skeleton).ToBody(in_m),
                   BodyTransfer(in_cm.skeleton, walk.skeleton).ToBody(in_cm), 1e-9);
}

TEST(BodyTransfer, UnknownFramesStayUnknown) {
  Motion rig = OnRig(Walk());
  rig.frames[3] = UnknownPose(rig.skeleton);
  const BodyTransfer transfer(rig.skeleton, testing::TrimmedCmuLikeSkeleton());
  Motion after = transfer.ToBody(rig);
  EXPECT_FALSE(IsKnown(after.frames[3]));
  after.frames[5] = UnknownPose(after.skeleton);
  const Motion carried = transfer.CarryBack(rig, after);
  for (size_t t = 0; t < carried.frames.size(); ++t)
    EXPECT_EQ(IsKnown(carried.frames[t]), t != 3 && t != 5);
}

TEST(BodyTransfer, RefusesWhatIsNoBody) {
  Skeleton rig = testing::RigSkeleton();
  rig.bones[*rig.FindBone("rig:LeftLeg")].name = "wheel";
  EXPECT_THROW(BodyTransfer(rig, testing::TrimmedCmuLikeSkeleton()), InputError);
  const BodyTransfer transfer(testing::RigSkeleton(), testing::TrimmedCmuLikeSkeleton());
  EXPECT_THROW(transfer.CarryBack(OnRig(Walk()), Motion{}), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
