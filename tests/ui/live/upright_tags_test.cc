// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: tags on a figure that stands before a level camera, each seen leaning its own way and
// another one.
#include "ui/live/upright_tags.h"

#include <gtest/gtest.h>

#include "src/forward_kinematics.h"
#include "src/level_camera.h"
#include "tests/support/cmu_like_skeleton.h"

namespace poselift {
namespace {

class UprightTagsTest : public ::testing::Test {
 protected:
  UprightTagsTest() {
    for (const char* bone : {"thorax", "head", "lhumerus"}) {
      const int id = static_cast<int>(tags_.tags.size());
      Eigen::Isometry3d bone_from_tag(Eigen::AngleAxisd(0.8 * id, Eigen::Vector3d::UnitY()));
      tags_.tags.push_back({.id = id, .size_m = 0.05});
      tags_.tags.back().on_bone = TagOnBone{.bone = bone, .bone_from_tag = bone_from_tag};
    }
  }
  // As on somebody who stands, turned about himself; behind a pose that leans by so much.
  TagSighting Seen(size_t tag, double turn_rad, double lean_rad) const {
    const Eigen::AngleAxisd turn(turn_rad, Eigen::Vector3d::UnitY());
    const TagOnBone& mount = *tags_.tags[tag].on_bone;
    SkeletonPose standing;
    standing.dofs = Eigen::VectorXd::Zero(skeleton_.NumDofs());
    BoneFrames frames;
    ForwardKinematics(skeleton_, standing, &frames);
    const auto bone = std::ranges::find(skeleton_.bones, mount.bone, &Bone::name);
    const Eigen::Matrix3d world_from_tag =
        turn * frames.world_from_bone[static_cast<size_t>(bone - skeleton_.bones.begin())] *
        mount.bone_from_tag.linear();
    TagSighting seen{.is_ambiguous = true};
    seen.detection.id = static_cast<int>(tag);
    for (const double rad : {lean_rad, 0.0}) {
      Eigen::Isometry3d cam_from_tag = Eigen::Isometry3d::Identity();
      cam_from_tag.linear() = kLevelFromCam.toRotationMatrix().transpose() *
                              Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitX()) * world_from_tag;
      seen.poses.push_back({.cam_from_tag = cam_from_tag});
    }
    return seen;
  }
  bool IsUprightFirst(const TagSighting& seen) const {
    std::vector<TagSighting> all = {seen};
    UprightTags(tags_, skeleton_, kLevelFromCam.conjugate()).PutFirst(&all);
    EXPECT_EQ(all[0].poses.size(), 2U);
    return all[0].poses[0].cam_from_tag.isApprox(seen.poses[1].cam_from_tag);
  }

  const Skeleton skeleton_ = testing::TrimmedCmuLikeSkeleton();
  BodyTags tags_;
};

TEST_F(UprightTagsTest, TrunkAndHeadHangAsOnSomebodyWhoStands) {
  for (const size_t tag : {0, 1})
    for (const double turn_rad : {0.0, 1.0, -2.0}) {
      EXPECT_TRUE(IsUprightFirst(Seen(tag, turn_rad, 0.7)));
      EXPECT_TRUE(IsUprightFirst(Seen(tag, turn_rad, -0.7)));
    }
}

TEST_F(UprightTagsTest, LimbsAndWhatCornersTellStayAsTheyAre) {
  EXPECT_FALSE(IsUprightFirst(Seen(2, 0.0, 0.7)));
  TagSighting sure = Seen(0, 0.0, 0.7);
  sure.is_ambiguous = false;
  EXPECT_FALSE(IsUprightFirst(sure));
}

}  // namespace
}  // namespace poselift
