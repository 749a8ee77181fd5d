// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The body found in made-up skeletons: CMU's names and a rig's, chains of other
// lengths, axes; and in what is no body.
#include "src/body_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/io/bvh_rig.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/rig_skeleton.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;

std::string NameOf(const Skeleton& skeleton, const BodyMap::Between& place) {
  if (!place.IsKnown()) return "";
  return place.IsOneBone() ? skeleton.bones[place.from].name
                           : skeleton.bones[place.from].name + "-" + skeleton.bones[place.to].name;
}

TEST(FindBody, ACmuSkeletonIsItself) {
  for (const Skeleton& skeleton : {testing::CmuLikeSkeleton(), testing::TrimmedCmuLikeSkeleton(),
                                   MakeBvhRig(testing::CmuLikeSkeleton()).skeleton}) {
    const BodyMap map = FindBody(skeleton);
    EXPECT_EQ(map.flaw, "");
    EXPECT_EQ(map.body_from_source, Eigen::Matrix3d::Identity());
    for (int j = 0; j < kNumJoints; ++j) {
      const bool is_fixed = j == joint::kLeftHip || j == joint::kRightHip ||
                            j == joint::kLeftShoulder || j == joint::kRightShoulder;
      EXPECT_EQ(NameOf(skeleton, map.source_of_body[j]), is_fixed ? "" : Joints()[j].cmu_bone);
    }
    for (size_t b = 0; b < skeleton.bones.size(); ++b)
      if (const BodyMap::Between& place = map.body_of_source[b]; place.IsKnown()) {
        EXPECT_EQ(Joints()[place.from].cmu_bone, skeleton.bones[b].name);
      }
  }
}

TEST(FindBody, ARigIsFoundByItsNamesAndItsTree) {
  const Skeleton rig = testing::RigSkeleton();
  const BodyMap map = FindBody(rig);
  EXPECT_EQ(map.flaw, "");
  EXPECT_EQ(rig.bones[map.pelvis].name, "rig:Hips");
  EXPECT_EQ(NameOf(rig, map.source_of_body[joint::kLeftKnee]), "rig:LeftUpLeg");
  EXPECT_EQ(NameOf(rig, map.source_of_body[joint::kRightFoot]), "rig:RightFoot");
  EXPECT_EQ(NameOf(rig, map.source_of_body[joint::kLeftHand]), "rig:LeftHand");
  EXPECT_EQ(NameOf(rig, map.source_of_body[joint::kThorax]), "rig:Spine3");
  EXPECT_EQ(NameOf(rig, map.source_of_body[joint::kHeadTop]), "rig:Head");
  EXPECT_EQ(NameOf(rig, map.source_of_body[joint::kLeftShoulder]), "");
  EXPECT_FALSE(map.body_of_source[*rig.FindBone("rig:LeftHandThumb1")].IsKnown());
  EXPECT_FALSE(map.body_of_source[0].IsKnown());
  // z is up, y to the back.
  EXPECT_EQ(map.body_from_source * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
  EXPECT_EQ(map.body_from_source * -Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ());
}

TEST(FindBody, ChainsOfOtherLengthsAreDividedAlike) {
  const Skeleton rig = testing::RigSkeleton();
  const BodyMap map = FindBody(rig);
  // The end of the first third of four bones is a third of the way into the second.
  const BodyMap::Between lower_back = map.source_of_body[joint::kLowerBack];
  EXPECT_EQ(NameOf(rig, lower_back), "rig:Spine-rig:Spine1");
  EXPECT_NEAR(lower_back.share, 1.0 / 3.0, 1e-12);
  const BodyMap::Between spine = map.body_of_source[*rig.FindBone("rig:Spine")];
  EXPECT_EQ(spine.from, joint::kPelvis);
  EXPECT_EQ(spine.to, joint::kLowerBack);
  EXPECT_NEAR(spine.share, 0.75, 1e-12);
  const BodyMap::Between lower_neck = map.source_of_body[joint::kLowerNeck];
  EXPECT_EQ(NameOf(rig, lower_neck), "rig:Spine3-rig:Neck");
  EXPECT_NEAR(lower_neck.share, 2.0 / 3.0, 1e-12);
}

TEST(FindBody, SaysWhichJointsAreMissing) {
  Skeleton rig = testing::RigSkeleton();
  rig.bones[*rig.FindBone("rig:LeftLeg")].name = "wheel";
  rig.bones[*rig.FindBone("rig:RightForeArm")].name = "crane";
  EXPECT_EQ(FindBody(rig).flaw, "found no bone for left_knee, right_elbow");
  EXPECT_THAT(FindBody(Skeleton{}).flaw, HasSubstr("left_hip"));
}

TEST(FindBody, HeadHandsAndFeetMayBeMissing) {
  Skeleton rig = testing::RigSkeleton();
  for (const char* name : {"rig:Head", "rig:LeftHand", "rig:RightFoot"})
    rig.bones[*rig.FindBone(name)].name = "other";
  const BodyMap map = FindBody(rig);
  EXPECT_EQ(map.flaw, "");
  for (const int joint : {joint::kHeadTop, joint::kLowerNeck, joint::kLeftHand, joint::kRightFoot})
    EXPECT_FALSE(map.source_of_body[joint].IsKnown());
}

TEST(FindBody, ARestPoseThatDoesNotStandSaysNothingOfAxes) {
  Skeleton rig = testing::RigSkeleton();
  rig.bones[*rig.FindBone("rig:LeftLeg")].offset_m *= -1.0;
  EXPECT_THAT(FindBody(rig).flaw, HasSubstr("does not stand"));
}

TEST(FindBody, ABoneThatTurnsTwiceAboutAnAxisIsNone) {
  Skeleton rig = testing::RigSkeleton();
  Bone& bone = rig.bones.back();
  bone.dofs = {{Dof::Kind::kRz}, {Dof::Kind::kRx}, {Dof::Kind::kRz}};
  EXPECT_EQ(FindBody(rig).flaw,
            "found that the bone " + bone.name + " turns twice about the same axis");
}

}  // namespace
}  // namespace poselift
