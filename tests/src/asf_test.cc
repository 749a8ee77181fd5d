// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up ASF through real files: what it means, that writing and reading are
// inverse, and that every malformed file is refused with its line.
#include "src/io/asf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/input_error.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::kMadeUpAsf;
using testing::MatrixNear;
using testing::ScratchDir;
using testing::WriteScratch;

AsfSkeleton ReadText(const std::string& text) {
  return ReadAsfSkeleton(WriteScratch("a.asf", text));
}

std::string ErrorOf(const std::string& text) {
  try {
    ReadText(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string Replaced(std::string_view from, std::string_view to) {
  std::string text(kMadeUpAsf);
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Eigen::Matrix3d Turn(int axis, double angle_deg) {
  return Eigen::AngleAxisd(angle_deg * kRadFromDeg, Eigen::Vector3d::Unit(axis)).matrix();
}

TEST(ReadAsf, PutsParentsFirstInTheOrderOfTheHierarchy) {
  const Skeleton skeleton = ReadText(std::string(kMadeUpAsf)).skeleton;
  std::vector<std::string> names;
  for (const Bone& bone : skeleton.bones) names.push_back(bone.name);
  EXPECT_THAT(names, ::testing::ElementsAre("root", "lhipjoint", "lfemur", "ltibia", "lfoot",
                                            "ltoes", "spine", "rhumerus", "rwrist"));
  for (size_t b = 1; b < skeleton.bones.size(); ++b) {
    EXPECT_LT(skeleton.bones[b].parent, static_cast<int>(b));
    EXPECT_EQ(skeleton.bones[b].offset_m, skeleton.bones[skeleton.bones[b].parent].tip_m);
  }
}

TEST(ReadAsf, MeansMetresRadiansAndTheAxesInTheirOrder) {
  const AsfSkeleton asf = ReadText(std::string(kMadeUpAsf));
  const Bone& femur = asf.skeleton.bones[2];
  EXPECT_NEAR(femur.tip_m.norm(), 7.4 / 0.45 * 0.0254, 1e-12);
  EXPECT_TRUE(MatrixNear(femur.rest_from_axis, Turn(2, 20), 1e-12));
  EXPECT_NEAR(femur.dofs[0].lower, -160 * kRadFromDeg, 1e-12);
  EXPECT_EQ(femur.dofs[2].upper, HUGE_VAL);
  const Bone& spine = asf.skeleton.bones[6];
  EXPECT_TRUE(MatrixNear(spine.rest_from_axis, Turn(1, 30) * Turn(0, 20) * Turn(2, 10), 1e-12));
  ASSERT_EQ(spine.dofs.size(), 5u);
  EXPECT_EQ(spine.dofs[1].kind, Dof::Kind::kTx);
  EXPECT_EQ(asf.skeleton.name, "made_up");
}

TEST(ReadAsf, TakesRadiansOtherRootsAndCarriageReturns) {
  std::string text = Replaced("angle deg", "angle rad");
  text.replace(text.find("order TX TY TZ RX RY RZ"), 23, "order rz rx ty");
  for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\r\n");
  const AsfSkeleton asf = ReadText(text);
  EXPECT_EQ(asf.radians_per_unit, 1.0);
  ASSERT_EQ(asf.root_channels.size(), 3u);
  EXPECT_EQ(asf.root_channels[2].kind, Dof::Kind::kTy);
  EXPECT_NEAR(asf.skeleton.bones[2].dofs[0].lower, -160.0, 1e-12);
}

TEST(WriteAsf, IsTheInverseOfReading) {
  const AsfSkeleton first = ReadText(Replaced("orientation 0 0 0", "orientation 10 20 30"));
  WriteAsf(first, ScratchDir() / "b.asf");
  const AsfSkeleton second = ReadAsfSkeleton(ScratchDir() / "b.asf");
  EXPECT_NEAR(second.metres_per_unit, first.metres_per_unit, 1e-12);
  EXPECT_TRUE(MatrixNear(second.root_rest_from_axis, first.root_rest_from_axis, 1e-11));
  ASSERT_EQ(second.skeleton.bones.size(), first.skeleton.bones.size());
  for (size_t b = 0; b < first.skeleton.bones.size(); ++b) {
    const Bone& a = first.skeleton.bones[b];
    const Bone& c = second.skeleton.bones[b];
    EXPECT_EQ(a.name, c.name);
    EXPECT_EQ(a.parent, c.parent);
    EXPECT_TRUE(MatrixNear(a.offset_m, c.offset_m, 1e-11));
    EXPECT_TRUE(MatrixNear(a.tip_m, c.tip_m, 1e-11));
    EXPECT_TRUE(MatrixNear(a.rest_from_axis, c.rest_from_axis, 1e-11));
    ASSERT_EQ(a.dofs.size(), c.dofs.size());
    for (size_t i = 0; i < a.dofs.size(); ++i) {
      EXPECT_EQ(a.dofs[i].kind, c.dofs[i].kind);
      if (std::isfinite(a.dofs[i].lower)) {
        EXPECT_NEAR(a.dofs[i].lower, c.dofs[i].lower, 1e-10);
      } else {
        EXPECT_EQ(a.dofs[i].lower, c.dofs[i].lower);
      }
    }
  }
}

TEST(ToAsfSkeleton, BridgesBonesThatBeginElsewhereAndCleansNames) {
  Skeleton skeleton;
  skeleton.bones = {{.name = "Hips", .tip_m = {0, 0.1, 0}},
                    {.name = "left leg", .parent = 0, .offset_m = {0.1, 0, 0}, .tip_m = {0, -1, 0}},
                    {.name = "7", .parent = 1, .offset_m = {0, -1, 0}, .tip_m = {0, 0, 0.1}},
                    {.name = "LEFT leg", .parent = 0, .offset_m = {0, 0, 0}}};
  const AsfSkeleton asf = ToAsfSkeleton(skeleton);
  std::vector<std::string> names;
  for (const Bone& bone : asf.skeleton.bones) names.push_back(bone.name);
  EXPECT_THAT(names,
              ::testing::ElementsAre("root", "left_legjoint", "left_leg", "_7", "LEFT_leg_2"));
  EXPECT_EQ(asf.skeleton.bones[2].offset_m, Eigen::Vector3d(0.1, 0, 0));
}

TEST(ReadAsf, RefusesMalformedFilesNamingTheLine) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("found nothing"));
  EXPECT_THAT(ErrorOf("hello"), HasSubstr("a.asf:1: found \"hello\""));
  EXPECT_THAT(ErrorOf(":version 1.10\n"), HasSubstr("wanted the sections"));
  EXPECT_THAT(ErrorOf(Replaced("length 0.45", "length 0")), HasSubstr("a.asf:6: "));
  EXPECT_THAT(ErrorOf(Replaced("angle deg", "angle grad")), HasSubstr("a.asf:7: found \"grad\""));
  EXPECT_THAT(ErrorOf(Replaced("order TX", "order QX")), HasSubstr("a.asf:11: found \"QX\""));
  EXPECT_THAT(ErrorOf(Replaced("order TX", "order TY")), HasSubstr("every channel once"));
  EXPECT_THAT(ErrorOf(Replaced("axis XYZ", "axis XYY")), HasSubstr("an axis order such as XYZ"));
  EXPECT_THAT(ErrorOf(Replaced("length 2.5", "length nan")), HasSubstr("a.asf:20: found \"nan\""));
  EXPECT_THAT(ErrorOf(Replaced("length 2.5", "length -1")), HasSubstr("a.asf:20: "));
  EXPECT_THAT(ErrorOf(Replaced("length 2.5", "length 1e999")), HasSubstr("a finite number"));
  EXPECT_THAT(ErrorOf(Replaced("length 2.5", "")), HasSubstr("without length"));
  EXPECT_THAT(ErrorOf(Replaced("0.66 -0.71 0.25", "0.66 -0.71")), HasSubstr("a.asf:19: "));
  EXPECT_THAT(ErrorOf(Replaced("0.66 -0.71 0.25", "0 0 0")), HasSubstr("direction 0 0 0"));
  EXPECT_THAT(ErrorOf(Replaced("dof rx\n", "dof l\n")), HasSubstr("not supported"));
  EXPECT_THAT(ErrorOf(Replaced("(-10.0 170.0)", "(-10.0)")), HasSubstr("wanted two for each"));
  EXPECT_THAT(ErrorOf(Replaced("(-10.0 170.0)", "(10 -10)")), HasSubstr("lower limit above"));
  EXPECT_THAT(ErrorOf(Replaced("name ltibia", "name LFEMUR")), HasSubstr("a second bone"));
  EXPECT_THAT(ErrorOf(Replaced("name spine", "name root")), HasSubstr("a bone named root"));
  EXPECT_THAT(ErrorOf(Replaced("spine rhumerus", "spine arm")), HasSubstr("found \"arm\""));
  EXPECT_THAT(ErrorOf(Replaced("spine rhumerus", "spine lfemur")), HasSubstr("one parent"));
  EXPECT_THAT(ErrorOf(Replaced("spine rhumerus", "spine root")), HasSubstr("has no parent"));
  EXPECT_THAT(ErrorOf(Replaced("spine rhumerus", "rwrist rhumerus")),
              HasSubstr("no way to the root"));
  EXPECT_THAT(ErrorOf(std::string(kMadeUpAsf) + ":hierarchy\n begin\n rwrist spine\n end\n"),
              HasSubstr("one parent"));
}

TEST(ReadAsf, SurvivesEveryTruncation) {
  const std::string text(kMadeUpAsf);
  for (size_t length = 0; length < text.size(); length += 7) {
    try {
      ReadText(text.substr(0, length));
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace poselift
