// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The tags that are printed for a body, on a made-up CMU skeleton. Checked: what faces where,
// and that the joint lies where the tag says.
#include "calib/body_tag_set.h"

#include <gtest/gtest.h>

#include "src/input_error.h"
#include "src/joints.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Eigen::Vector3d;
using testing::MatrixNear;

class BodyTagSetTest : public ::testing::Test {
 protected:
  Eigen::Isometry3d BoneFromTag(const std::string& name) const {
    for (const BodyTag& tag : on_bones_.tags)
      if (tag.name == name) return tag.on_bone->bone_from_tag;
    throw std::logic_error("no such tag: " + name);
  }
  Vector3d Outward(const std::string& name) const { return -BoneFromTag(name).linear().col(2); }
  Vector3d Down(const std::string& name) const { return BoneFromTag(name).linear().col(1); }

  Skeleton skeleton_ = testing::TrimmedCmuLikeSkeleton();
  BodyTags printed_ = DefaultBodyTags();
  BodyTags on_bones_ = OnBones(printed_, skeleton_);
};

TEST_F(BodyTagSetTest, EveryTagSitsOnTheBoneThatEndsAtItsJoint) {
  ASSERT_EQ(on_bones_.tags.size(), 16U);
  for (size_t i = 0; i < on_bones_.tags.size(); ++i) {
    const BodyTag& tag = on_bones_.tags[i];
    ASSERT_TRUE(tag.on_bone && !tag.on_joint) << tag.name;
    const auto joint = static_cast<size_t>(*FindJoint(printed_.tags[i].on_joint->joint));
    const Bone& bone = skeleton_.bones[joint];
    EXPECT_EQ(tag.on_bone->bone, bone.name);
    EXPECT_NEAR(tag.on_bone->bone_from_tag.linear().determinant(), 1.0, 1e-9) << tag.name;
    EXPECT_TRUE(MatrixNear(tag.on_bone->bone_from_tag * printed_.tags[i].on_joint->joint_in_tag_m,
                           bone.tip_m, 1e-12))
        << tag.name;
  }
}

// At rest the arms are level: what hangs down then points outward here, and the outside up.
TEST_F(BodyTagSetTest, TagsFaceWhereTheSheetSaysThemToBeStuck) {
  EXPECT_TRUE(MatrixNear(Outward("chest"), Vector3d::UnitZ(), 1e-9));
  EXPECT_TRUE(MatrixNear(Outward("back"), -Vector3d::UnitZ(), 1e-9));
  EXPECT_TRUE(MatrixNear(Down("head"), -Vector3d::UnitY(), 1e-9));
  EXPECT_TRUE(MatrixNear(Down("pelvis"), -Vector3d::UnitY(), 1e-9));
  for (const char* tag : {"left_thigh", "right_shin"}) {
    EXPECT_GT(Outward(tag).z(), 0.9) << tag;
    EXPECT_LT(Down(tag).y(), -0.9) << tag;
  }
  for (const char* tag : {"upper_arm", "forearm", "hand"}) {
    EXPECT_GT(Outward(std::string("left_") + tag).y(), 0.9) << tag;
    EXPECT_GT(Outward(std::string("right_") + tag).y(), 0.9) << tag;
    EXPECT_GT(Down(std::string("left_") + tag).x(), 0.9) << tag;
    EXPECT_LT(Down(std::string("right_") + tag).x(), -0.9) << tag;
  }
  EXPECT_GT(Outward("left_foot").y(), 0.5);
  EXPECT_GT(Down("left_foot").z(), 0.5);
}

TEST_F(BodyTagSetTest, ATagCannotFaceAlongItsBone) {
  for (const size_t tag : {3, 4}) {  // the head, an arm
    BodyTags tags = printed_;
    tags.tags[tag].on_joint->faces = TagFacing::kUp;
    EXPECT_THROW(OnBones(tags, skeleton_), InputError) << tags.tags[tag].name;
  }
}

TEST_F(BodyTagSetTest, TagsThatDoNotSayWhatTheyFaceStayByTheirJoint) {
  printed_.tags[5].on_joint->faces.reset();
  const BodyTags on_bones = OnBones(printed_, skeleton_);
  EXPECT_TRUE(on_bones.tags[5].on_joint && !on_bones.tags[5].on_bone);
}

}  // namespace
}  // namespace poselift
