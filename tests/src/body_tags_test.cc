// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the readers of tags.toml and of apriltag_ros' tags.yaml, the writer. Made up: files.
// Checked: every key, the frames of ROS, bad files with their lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/body_segments.h"
#include "src/input_error.h"
#include "src/io/body_tags_toml.h"
#include "src/joints.h"
#include "src/units.h"
#include "tests/support/broken_input.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::MatrixNear;
using testing::Replaced;
using testing::WriteScratch;

const std::string kToml = R"(# of one person
family = "tag25h9"
size_mm = 80

[[tag]]
id = 3
name = "left \"knee\""
joint = "left_knee"
joint_in_tag_mm = [0, -12.5, 60]
joint_sigma_mm = 15
faces = "right"

[[tag]]
id = 0
size_mm = 55.5
bone = "left_shin"
position_mm = [10.0, 20, -30]
rotation = [0.0, 1.0, 0.0, 0.0]
rotation_sigma_deg = 4.5

[[tag]]
id = 34
joint = "head"
bone = "LRADIUS"
position_mm = [0, 0, 0]
rotation = [1, 0, 0, 0]
position_sigma_mm = 3

[bone_lengths_mm]
left_knee = 431.25
left_ankle = 400
)";

const std::string kYaml = R"(standalone_tags:
  [
    {id: 4, size: 0.08, name: left_wrist},
  ]
tag_bundles:
  - name: left_shin
    layout:
      - {id: 7, size: 0.05, x: 0.1, y: 0.2, z: 0.3, qw: 1, qx: 0, qy: 0, qz: 0}
      - {id: 8, size: 0.05, x: 0, y: 0, z: 0, qw: 0.70710678, qx: 0, qy: 0, qz: 0.70710678}
  - name: right_knee
    layout:
      - {id: 9, size: 0.06, x: 0.01, y: 0.02, z: 0.05, qw: 1, qx: 0, qy: 0, qz: 0}
)";

std::string ErrorOf(const std::string& text, const std::string& name = "tags.toml") {
  try {
    ReadBodyTags(WriteScratch(name, text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(BodyTagsTest, EveryKeyOfTheFileArrivesInSiUnits) {
  const BodyTags tags = ReadBodyTags(WriteScratch("tags.toml", kToml));
  EXPECT_EQ(tags.family, "tag25h9");
  ASSERT_EQ(tags.tags.size(), 3U);
  const BodyTag& knee = *tags.Find(3);
  EXPECT_EQ(knee.name, "left \"knee\"");
  EXPECT_DOUBLE_EQ(knee.size_m, 0.08);
  ASSERT_TRUE(knee.on_joint && !knee.on_bone);
  EXPECT_EQ(knee.on_joint->joint, "left_knee");
  EXPECT_TRUE(MatrixNear(knee.on_joint->joint_in_tag_m, Eigen::Vector3d(0, -0.0125, 0.06), 1e-15));
  EXPECT_DOUBLE_EQ(knee.on_joint->sigma_m, 0.015);
  EXPECT_EQ(knee.on_joint->faces, TagFacing::kRight);
  const BodyTag& shin = *tags.Find(0);
  EXPECT_DOUBLE_EQ(shin.size_m, 0.0555);
  ASSERT_TRUE(shin.on_bone && !shin.on_joint);
  EXPECT_EQ(shin.on_bone->bone, "ltibia");
  EXPECT_TRUE(MatrixNear(shin.on_bone->bone_from_tag.translation(),
                         Eigen::Vector3d(0.01, 0.02, -0.03), 1e-15));
  EXPECT_TRUE(MatrixNear(shin.on_bone->bone_from_tag.linear(),
                         Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), 1e-15));
  EXPECT_DOUBLE_EQ(shin.on_bone->sigma_m, TagOnBone{}.sigma_m);
  EXPECT_DOUBLE_EQ(shin.on_bone->sigma_rad, 4.5 * kRadFromDeg);
  const BodyTag& both = *tags.Find(34);
  EXPECT_EQ(both.on_joint->joint, "head_top");
  EXPECT_FALSE(both.on_joint->faces);
  EXPECT_EQ(both.on_bone->bone, "lradius");
  EXPECT_DOUBLE_EQ(both.on_bone->sigma_m, 0.003);
  ASSERT_EQ(tags.bone_lengths_m.size(), 2U);
  EXPECT_EQ(tags.bone_lengths_m[1].first, "left_knee");
  EXPECT_DOUBLE_EQ(tags.bone_lengths_m[1].second, 0.43125);
}

TEST(BodyTagsTest, WhatIsWrittenIsReadAgainToTheLastButOneBit) {
  std::mt19937_64 rng = testing::TestRng();
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  BodyTags tags;
  tags.bone_lengths_m = {{"left_knee", 0.1 + 0.3 * std::abs(unit(rng))}};
  for (int id = 0; id < 40; ++id) {
    BodyTag tag{.id = id, .size_m = 0.05 + 0.01 * unit(rng), .name = "a \\ \"b\"\t\x01 \xC3\xA9"};
    if (id % 3 != 0)
      tag.on_joint = TagOnJoint{.joint = "left_knee",
                                .joint_in_tag_m = {unit(rng), 1e-9 * unit(rng), unit(rng)},
                                .sigma_m = 0.02 + 0.01 * unit(rng)};
    if (id % 3 == 1) tag.on_joint->faces = static_cast<TagFacing>(id % 5);
    if (id % 3 != 1) {
      tag.on_bone = TagOnBone{.bone = "upperneck", .sigma_rad = 0.1 + 0.05 * unit(rng)};
      tag.on_bone->bone_from_tag.translation() << unit(rng), unit(rng), unit(rng);
      tag.on_bone->bone_from_tag.linear() =
          Eigen::Quaterniond(unit(rng), unit(rng), unit(rng), unit(rng)).normalized().matrix();
    }
    tags.tags.push_back(tag);
  }
  const std::filesystem::path path = testing::ScratchDir() / "out.toml";
  WriteBodyTags(tags, path);
  const BodyTags again = ReadBodyTags(path);
  ASSERT_EQ(again.tags.size(), tags.tags.size());
  for (size_t i = 0; i < tags.tags.size(); ++i) {
    const BodyTag &a = tags.tags[i], &b = again.tags[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.name, b.name);
    EXPECT_DOUBLE_EQ(a.size_m, b.size_m);
    ASSERT_EQ(a.on_joint.has_value(), b.on_joint.has_value());
    ASSERT_EQ(a.on_bone.has_value(), b.on_bone.has_value());
    if (a.on_joint) {
      EXPECT_TRUE(MatrixNear(a.on_joint->joint_in_tag_m, b.on_joint->joint_in_tag_m, 1e-15));
      EXPECT_DOUBLE_EQ(a.on_joint->sigma_m, b.on_joint->sigma_m);
      EXPECT_EQ(a.on_joint->faces, b.on_joint->faces);
    }
    if (a.on_bone) {
      EXPECT_EQ(a.on_bone->bone, b.on_bone->bone);
      EXPECT_TRUE(
          MatrixNear(a.on_bone->bone_from_tag.matrix(), b.on_bone->bone_from_tag.matrix(), 1e-14));
      EXPECT_DOUBLE_EQ(a.on_bone->sigma_rad, b.on_bone->sigma_rad);
    }
  }
  EXPECT_DOUBLE_EQ(again.bone_lengths_m[0].second, tags.bone_lengths_m[0].second);
}

TEST(BodyTagsTest, RoundNumbersAreWrittenRound) {
  const BodyTags tags = ReadBodyTags(WriteScratch("tags.toml", kToml));
  const std::string text = BodyTagsToml(tags);
  EXPECT_THAT(text, HasSubstr("size_mm = 80\n"));
  EXPECT_THAT(text, HasSubstr("joint_in_tag_mm = [0, -12.5, 60]\n"));
  EXPECT_THAT(text, HasSubstr("rotation_sigma_deg = 4.5\n"));
  EXPECT_THAT(text, HasSubstr("bone = \"left_shin\"\n"));
  EXPECT_THAT(text, HasSubstr("left_knee = 431.25\n"));
}

TEST(BodyTagsTest, BadFilesSayWhereAndWhatIsWanted) {
  const auto after = [](const std::string& old, const std::string& with) {
    return ErrorOf(Replaced(kToml, old, with));
  };
  EXPECT_THAT(after("size_mm = 80", "size_mm = 80 mm"), HasSubstr("tags.toml:3: "));
  EXPECT_THAT(after("joint_in_tag_mm", "joint_in_tag_m"),
              HasSubstr("tags.toml:9: found the unknown key \"joint_in_tag_m\", wanted perhaps "
                        "\"joint_in_tag_mm\""));
  EXPECT_THAT(after("\"left_knee\"\njoint_in", "\"left_kne\"\njoint_in"),
              HasSubstr("tags.toml:8: found the unknown joint \"left_kne\", wanted perhaps "
                        "\"left_knee\""));
  EXPECT_THAT(after("left_shin", "left_chin"), HasSubstr("tags.toml:16: found the unknown bone"));
  EXPECT_THAT(after("[0.0, 1.0, 0.0, 0.0]", "[0.5, 0.5, 0.0, 0.0]"), HasSubstr("tags.toml:18: "));
  EXPECT_THAT(after("[0.0, 1.0, 0.0, 0.0]", "[0, 1, 0]"), HasSubstr("wanted 4 numbers"));
  EXPECT_THAT(after("[0.0, 1.0, 0.0, 0.0]", "[0, nan, 0, 0]"), HasSubstr("tags.toml:18: "));
  EXPECT_THAT(after("id = 0\n", "id = 3\n"), HasSubstr("tags.toml:13: found the tag 3 twice"));
  EXPECT_THAT(after("id = 0\n", "id = -1\n"), HasSubstr("tags.toml:14: id: wanted a whole number"));
  EXPECT_THAT(after("id = 0\n", ""), HasSubstr("tags.toml:13: id is missing"));
  EXPECT_THAT(after("size_mm = 80\n", ""), HasSubstr("tags.toml:4: size_mm is missing"));
  EXPECT_THAT(after("55.5", "0"), HasSubstr("tags.toml:15: size_mm"));
  EXPECT_THAT(after("bone = \"left_shin\"\n", ""), HasSubstr("found position_mm without bone"));
  EXPECT_THAT(after("position_mm = [10.0, 20, -30]\n", ""), HasSubstr("position_mm is missing"));
  EXPECT_THAT(after("left_ankle = 400", "left_ancle = 400"),
              HasSubstr("tags.toml:31: found the unknown joint"));
  EXPECT_THAT(ErrorOf("[[tag]]\nid = 1\nsize_mm = 50\n"), HasSubstr("sits nowhere"));
  EXPECT_THAT(ErrorOf("family = \"tag36h11\"\n"), HasSubstr("found no tags"));
  EXPECT_THAT(ErrorOf("tag = 3\n"), HasSubstr("wanted [[tag]]"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("found no tags"));
  std::string deep = "size_mm";
  for (int i = 0; i < 200000; ++i) deep += ".a";
  EXPECT_THAT(ErrorOf("# ...\n" + deep + " = 1\n"),
              HasSubstr("tags.toml:2: found more than 48 dots"));
  EXPECT_THROW(ReadBodyTags(testing::ScratchDir() / "none.toml"), InputError);
  EXPECT_THAT(after("\"right\"\n", "\"inside\"\n"),
              HasSubstr("tags.toml:11: faces: wanted \"front\""));
  EXPECT_THAT(after("bone = \"left_shin\"", "bone = \"left_shin\"\nfaces = \"up\""),
              HasSubstr("found faces without joint"));
}

TEST(BodyTagsTest, TheFileOfRosIsTurnedIntoOurFrames) {
  const BodyTags tags = ReadBodyTags(WriteScratch("tags.yaml", kYaml));
  ASSERT_EQ(tags.tags.size(), 4U);
  EXPECT_EQ(tags.Find(4)->on_joint->joint, "left_wrist");
  EXPECT_DOUBLE_EQ(tags.Find(4)->size_m, 0.08);
  const TagOnBone& plain = *tags.Find(7)->on_bone;
  EXPECT_EQ(plain.bone, "ltibia");
  // Their y is up and their z out of the paper: ours are down and into it.
  const Eigen::Vector3d below_in_tag(0, 0.01, 0), behind_in_tag(0, 0, 0.01);
  EXPECT_TRUE(
      MatrixNear(plain.bone_from_tag * below_in_tag, Eigen::Vector3d(0.1, 0.19, 0.3), 1e-12));
  EXPECT_TRUE(
      MatrixNear(plain.bone_from_tag * behind_in_tag, Eigen::Vector3d(0.1, 0.2, 0.29), 1e-12));
  // A quarter about z first.
  EXPECT_TRUE(MatrixNear(tags.Find(8)->on_bone->bone_from_tag * Eigen::Vector3d(1, 0, 0),
                         Eigen::Vector3d(0, 1, 0), 1e-7));
  // The joint is the bundle's origin: left of, below and behind the tag.
  EXPECT_TRUE(MatrixNear(tags.Find(9)->on_joint->joint_in_tag_m, Eigen::Vector3d(-0.01, 0.02, 0.05),
                         1e-12));
}

TEST(BodyTagsTest, NamesOfRosAreFreeBesideAJointOrABone) {
  std::string yaml = Replaced(kYaml, "name: left_wrist", "name: marker_1, joint: left_wrist");
  yaml = Replaced(yaml, "name: left_shin", "name: plate\n    bone: left_shin");
  const BodyTags tags = ReadBodyTags(WriteScratch("tags.yaml", yaml));
  EXPECT_EQ(tags.Find(4)->name, "marker_1");
  EXPECT_EQ(tags.Find(4)->on_joint->joint, "left_wrist");
  EXPECT_EQ(tags.Find(7)->name, "plate");
  EXPECT_EQ(tags.Find(7)->on_bone->bone, "ltibia");
}

TEST(BodyTagsTest, WhoWantsNoPlacesTakesAnyNamesOfRos) {
  const std::string path = WriteScratch(
      "tags.yaml",
      "standalone_tags:\n  [{id: 3, size: 0.07, name: table}, {id: 4, size: 0.08}]\n"
      "tag_bundles: [{name: plate, layout: [{id: 7, size: 0.05, x: 0.1, y: 0, z: 0}]}]\n");
  const BodyTags tags = ReadBodyTags(path, TagPlaces::kAny);
  ASSERT_EQ(tags.tags.size(), 3U);
  EXPECT_EQ(tags.Find(3)->name, "table");
  EXPECT_EQ(tags.Find(4)->size_m, 0.08);
  EXPECT_EQ(tags.Find(7)->name, "plate");
  EXPECT_THROW(ReadBodyTags(path), InputError);
}

TEST(BodyTagsTest, BadFilesOfRosSayWhereAndWhatIsWanted) {
  const auto after = [](const std::string& old, const std::string& with) {
    return ErrorOf(Replaced(kYaml, old, with), "tags.yaml");
  };
  EXPECT_THAT(after("left_wrist", "left_rist"),
              HasSubstr("tags.yaml:3: found the unknown joint \"left_rist\", wanted perhaps"));
  EXPECT_THAT(after("left_wrist", "left_shin"), HasSubstr("tags.yaml:3: found the bone"));
  EXPECT_THAT(after("name: left_shin", "name: Tisch"), HasSubstr("tags.yaml:6: found the unknown"));
  // The names there are, and what to do.
  EXPECT_THAT(after("left_wrist", "marker_1"), HasSubstr("joint: NAME beside them"));
  EXPECT_THAT(after("left_wrist", "marker_1"), HasSubstr("left_knee"));
  EXPECT_THAT(after("id: 8", "id: 7"), HasSubstr("tags.yaml:9: found the tag 7 twice"));
  EXPECT_THAT(after("size: 0.08", "size: 80"), HasSubstr("tags.yaml:3: size: wanted metres"));
  EXPECT_THAT(after("qw: 1,", "qw: 2,"), HasSubstr("tags.yaml:8: "));
  EXPECT_THAT(after("x: 0.1", "x: .nan"), HasSubstr("tags.yaml:8: x"));
  EXPECT_THAT(after("x: 0.1", "x: east"), HasSubstr("tags.yaml:8: x"));
  EXPECT_THAT(after("  ]", "  )"), HasSubstr("tags.yaml:"));
  EXPECT_THAT(ErrorOf("- 3\n", "tags.yaml"), HasSubstr("standalone_tags"));
  EXPECT_THAT(ErrorOf("", "tags.yaml"), HasSubstr("standalone_tags"));
  EXPECT_THAT(ErrorOf("standalone_tags: 3\n", "tags.yml"), HasSubstr("wanted a list"));
}

TEST(BodyTagsTest, DeepNestingIsRefused) {
  const std::string deep(200000, '[');
  EXPECT_NE(ErrorOf("tag = " + deep), "none");
  EXPECT_NE(ErrorOf(deep, "tags.yaml"), "none");
  EXPECT_NE(ErrorOf("standalone_tags: " + std::string(200000, '{'), "tags.yaml"), "none");
}

TEST(BodySegmentsTest, EverySegmentIsABoneThatEndsAtAJoint) {
  for (const BodySegment& segment : BodySegments()) {
    EXPECT_EQ(FindBodyBone(segment.name), std::string(segment.cmu_bone));
    EXPECT_EQ(SegmentName(segment.cmu_bone), segment.name);
    EXPECT_TRUE(std::any_of(Joints().begin(), Joints().end(), [&](const JointInfo& joint) {
      return joint.cmu_bone == segment.cmu_bone;
    })) << segment.name;
  }
  EXPECT_EQ(FindBodyBone("LFEMUR"), "lfemur");
  EXPECT_EQ(FindBodyBone("tail"), std::nullopt);
  EXPECT_EQ(SegmentName("lhipjoint"), "lhipjoint");
}

}  // namespace
}  // namespace poselift
