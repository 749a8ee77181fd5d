// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up CMU skeleton. Checked: the tags' frames and that paper and body do not meet.
#include "src/testing/tag_placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/tag_detection.h"
#include "src/testing/body_shape.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/support.h"

namespace poselift::testing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

struct Resting {
  explicit Resting(const Skeleton& of) : skeleton(of) {
    ForwardKinematics(of, SkeletonPose::Rest(of), &frames);
  }
  Eigen::Isometry3d WorldFromTag(const BodyTag& tag) const {
    const int bone = *skeleton.FindBone(tag.on_bone->bone);
    return Eigen::Translation3d(frames.start_in_world_m.col(bone)) * tag.on_bone->bone_from_tag;
  }
  const Skeleton& skeleton;
  BoneFrames frames;
};

TEST(DefaultTagPlacementTest, ATagIsARightHandedFrameThatLooksIntoTheBody) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const Resting resting(skeleton);
  for (const BodyTag& tag : DefaultTagPlacement(skeleton, {.around = true}).tags) {
    const Eigen::Isometry3d world_from_tag = resting.WorldFromTag(tag);
    EXPECT_NEAR(world_from_tag.linear().determinant(), 1.0, 1e-9) << tag.name;
    EXPECT_TRUE(MatrixNear(world_from_tag.linear() * world_from_tag.linear().transpose(),
                           Eigen::Matrix3d::Identity(), 1e-9));
    const int bone = *skeleton.FindBone(tag.on_bone->bone);
    const Vector3d bone_in_tag_m =
        world_from_tag.inverse() * Vector3d(0.5 * (resting.frames.start_in_world_m.col(bone) +
                                                   resting.frames.tip_in_world_m.col(bone)));
    EXPECT_GT(bone_in_tag_m.z(), 0.0) << tag.name;
  }
}

TEST(DefaultTagPlacementTest, PrintsStandUprightOnOneWhoIsLookedAtFromBefore) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const Resting resting(skeleton);
  const BodyTags tags = DefaultTagPlacement(skeleton);
  ASSERT_EQ(tags.tags.size(), 13u);
  const auto world_from = [&](const std::string& name) -> Eigen::Matrix3d {
    for (const BodyTag& tag : tags.tags)
      if (tag.name == name) return resting.WorldFromTag(tag).linear();
    throw std::logic_error("no such tag: " + name);
  };
  EXPECT_TRUE(MatrixNear(world_from("chest front"),
                         Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), 1e-9));
  EXPECT_LT(world_from("left thigh front")(1, 1), -0.9);
  // The arms are level at rest: what will be down is outward.
  EXPECT_GT(world_from("left forearm front")(0, 1), 0.99);
  EXPECT_LT(world_from("right forearm front")(0, 1), -0.99);
}

// No ray that falls on the paper from before it meets the body earlier, and some meet
// it soon after.
TEST(DefaultTagPlacementTest, PaperLiesJustOutsideOfTheBody) {
  for (const Skeleton& skeleton : {TrimmedCmuLikeSkeleton(), CmuLikeSkeleton()}) {
    const Resting resting(skeleton);
    for (const double size_m : {0.06, 0.1}) {
      const BodyTags tags = DefaultTagPlacement(skeleton, {.size_m = size_m, .around = true});
      for (const BodyTag& tag : tags.tags) {
        const Eigen::Isometry3d eye_from_rest =
            Eigen::Translation3d(0, 0, 5) * resting.WorldFromTag(tag).inverse();
        double nearest_m = 1e9;
        for (const BodyPart& part : BodyAround(skeleton)) {
          const SeenRoundCone seen(
              part.cone,
              eye_from_rest * Eigen::Translation3d(resting.frames.start_in_world_m.col(part.bone)));
          for (double u = -1.0; u <= 1.0; u += 0.125)
            for (double v = -1.0; v <= 1.0; v += 0.125) {
              const Eigen::Vector2d at_m = 0.5 * 1.25 * size_m * Eigen::Vector2d(u, v);
              const double depth_m = seen.Depth_m((at_m / 5).cast<float>());
              if (depth_m > 4.7) nearest_m = std::min(nearest_m, depth_m);  // not a foot far below
            }
        }
        EXPECT_GT(nearest_m, 5.002) << skeleton.name << " " << tag.name;
        EXPECT_LT(nearest_m, 5.006) << skeleton.name << " " << tag.name;
      }
    }
  }
}

TEST(DefaultTagPlacementTest, TagsAroundTheBodyBeginWithThoseBeforeIt) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const BodyTags front = DefaultTagPlacement(skeleton, {.first_id = 7});
  const BodyTags around = DefaultTagPlacement(skeleton, {.around = true, .first_id = 7});
  EXPECT_EQ(around.tags.size(), 36u);
  std::set<int> ids;
  std::set<std::string> names;
  for (size_t i = 0; i < around.tags.size(); ++i) {
    ids.insert(around.tags[i].id);
    names.insert(around.tags[i].name);
    if (i >= front.tags.size()) continue;
    EXPECT_EQ(front.tags[i].id, around.tags[i].id);
    EXPECT_TRUE(MatrixNear(front.tags[i].on_bone->bone_from_tag.matrix(),
                           around.tags[i].on_bone->bone_from_tag.matrix(), 0.0));
  }
  EXPECT_EQ(ids.size(), around.tags.size());
  EXPECT_EQ(names.size(), around.tags.size());
  EXPECT_EQ(*ids.begin(), 7);
}

TEST(OnSurfaceTest, MovesTagsAlongTheirNormalsToWhereTheyArePlaced) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const BodyTags placed = DefaultTagPlacement(skeleton, {.around = true});
  BodyTags moved = placed;
  for (BodyTag& tag : moved.tags)
    tag.on_bone->bone_from_tag =
        tag.on_bone->bone_from_tag * Eigen::Translation3d(0, 0, tag.id % 2 == 0 ? 0.02 : -0.03);
  const BodyTags back = OnSurface(moved, skeleton);
  for (size_t i = 0; i < placed.tags.size(); ++i)
    EXPECT_TRUE(MatrixNear(back.tags[i].on_bone->bone_from_tag.matrix(),
                           placed.tags[i].on_bone->bone_from_tag.matrix(), 2e-3))
        << placed.tags[i].name;
  moved.tags[3].on_bone->bone = "tail";
  EXPECT_THROW(OnSurface(moved, skeleton), InputError);
}

TEST(DefaultTagPlacementTest, BadOptionsAndSkeletonsAreRefused) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  EXPECT_THROW(DefaultTagPlacement(skeleton, {.size_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(DefaultTagPlacement(skeleton, {.size_m = NAN}), std::invalid_argument);
  EXPECT_THROW(DefaultTagPlacement(skeleton, {.paper_per_size = 0.9}), std::invalid_argument);
  EXPECT_THROW(DefaultTagPlacement(skeleton, {.gap_m = -0.1}), std::invalid_argument);
  EXPECT_THROW(DefaultTagPlacement(skeleton, {.first_id = -1}), std::invalid_argument);
  Skeleton headless = skeleton;
  headless.bones[*skeleton.FindBone("head")].name = "skull";
  try {
    DefaultTagPlacement(headless);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'head'"));
  }
  EXPECT_THROW(DefaultTagPlacement({"rig", {{.name = "Hips"}}}), InputError);
}

}  // namespace
}  // namespace poselift::testing
