// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// AMC files of a made-up skeleton through real files: meaning, inverse pair,
// and what a malformed file says.
#include "src/io/amc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "src/input_error.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ExpectSamePlaces;
using ::testing::HasSubstr;
using testing::kMadeUpAsf;
using testing::MatrixNear;
using testing::RandomMotion;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

constexpr double kUnit_m = 0.0254 / 0.45;

AsfSkeleton MadeUp() { return ReadAsfSkeleton(WriteScratch("m.asf", std::string(kMadeUpAsf))); }

Motion ReadText(const std::string& text, const AsfSkeleton& asf = MadeUp()) {
  return ReadAmc(WriteScratch("m_1.amc", text), asf);
}

std::string ErrorOf(const std::string& text) {
  try {
    ReadText(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadAmc, MeansMetresAndRadiansInTheOrderOfTheDofs) {
  const Motion motion = ReadText(
      "#!OML:ASF x.asf\r\n:FULLY-SPECIFIED\r\n:DEGREES\r\n1\r\n"
      "root 1 2 3 0 0 90\r\nspine 90 1 0 2 0\r\n# note\r\nltibia 45 # knee\r\n");
  ASSERT_EQ(motion.frames.size(), 1u);
  EXPECT_EQ(motion.frame_time_s, 1.0 / 120.0);
  const SkeletonPose& pose = motion.frames[0];
  EXPECT_TRUE(MatrixNear(pose.root_in_world_m, Eigen::Vector3d(1, 2, 3) * kUnit_m, 1e-12));
  EXPECT_TRUE(
      MatrixNear(pose.world_from_root * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 1e-12));
  const auto starts = motion.skeleton.DofStarts();
  const int spine = starts[*motion.skeleton.FindBone("spine")];
  EXPECT_NEAR(pose.dofs[spine], M_PI / 2, 1e-12);
  EXPECT_NEAR(pose.dofs[spine + 1], kUnit_m, 1e-12);
  EXPECT_NEAR(pose.dofs[spine + 3], 2 * kUnit_m, 1e-12);
  EXPECT_NEAR(pose.dofs[starts[*motion.skeleton.FindBone("ltibia")]], M_PI / 4, 1e-12);
  EXPECT_EQ(pose.dofs[starts[*motion.skeleton.FindBone("rwrist")]], 0.0);  // not in the file
}

TEST(ReadAmc, TakesRadiansAndOtherRootOrders) {
  AsfSkeleton asf = MadeUp();
  asf.root_channels = {{Dof::Kind::kRz}, {Dof::Kind::kTy}, {Dof::Kind::kRx}};
  asf.root_position_m = {1, 1, 1};
  const Motion motion = ReadText(":RADIANS\n7\nroot 1.5707963267948966 2 0\n8\nroot 0 0 0", asf);
  ASSERT_EQ(motion.frames.size(), 2u);
  EXPECT_TRUE(
      MatrixNear(motion.frames[0].root_in_world_m, Eigen::Vector3d(1, 1 + 2 * kUnit_m, 1), 1e-12));
  EXPECT_TRUE(MatrixNear(motion.frames[0].world_from_root * Eigen::Vector3d::UnitX(),
                         Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(WriteAmc, IsTheInverseOfReading) {
  auto rng = TestRng();
  AsfSkeleton asf = MadeUp();
  asf.root_rest_from_axis = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  asf.root_channels = {{Dof::Kind::kRz}, {Dof::Kind::kTx}, {Dof::Kind::kRx},
                       {Dof::Kind::kTy}, {Dof::Kind::kRy}, {Dof::Kind::kTz}};
  for (const double radians_per_unit : {kRadFromDeg, 1.0}) {
    asf.radians_per_unit = radians_per_unit;
    Motion motion = RandomMotion(asf.skeleton, 50, &rng);
    WriteAmc(motion, asf, ScratchDir() / "b.amc");
    const Motion again = ReadAmc(ScratchDir() / "b.amc", asf, motion.frame_time_s);
    ExpectSamePlaces(motion, again, 1e-7);
    for (size_t f = 0; f < motion.frames.size(); ++f)
      EXPECT_TRUE(MatrixNear(motion.frames[f].dofs, again.frames[f].dofs, 1e-7));
  }
}

TEST(WriteAmc, WritesRootAnglesWithoutJumps) {
  AsfSkeleton asf;
  asf.skeleton.bones = {{.name = "root"}};
  Motion motion{asf.skeleton, 0.1, {}};
  for (int f = 0; f < 4; ++f) {
    SkeletonPose pose = SkeletonPose::Rest(asf.skeleton);
    pose.world_from_root = Eigen::AngleAxisd(f * 100 * kRadFromDeg, Eigen::Vector3d::UnitY());
    motion.frames.push_back(pose);
  }
  WriteAmc(motion, asf, ScratchDir() / "turn.amc");
  std::ifstream file(ScratchDir() / "turn.amc");
  std::string word;
  double values[6] = {};
  for (double wanted_deg = 0.0; file >> word;) {
    if (word != "root") continue;
    for (double& value : values) file >> value;
    // Beyond 90 degrees about y another Euler branch has smaller angles.
    EXPECT_NEAR(values[3], 0.0, 1e-6);
    EXPECT_NEAR(values[4], wanted_deg, 1e-6);
    EXPECT_NEAR(values[5], 0.0, 1e-6);
    wanted_deg += 100.0;
  }
  EXPECT_NEAR(values[4], 300.0, 1e-6);
}

TEST(WriteAmc, RefusesANaNAndLeavesNoFile) {
  const AsfSkeleton asf = MadeUp();
  Motion motion{asf.skeleton, 0.1, {SkeletonPose::Rest(asf.skeleton)}};
  motion.frames[0].dofs[3] = std::nan("");
  EXPECT_THROW(WriteAmc(motion, asf, ScratchDir() / "nan.amc"), InputError);
  EXPECT_FALSE(std::filesystem::exists(ScratchDir() / "nan.amc"));
}

TEST(FindAsfOf, KnowsTheNamesOfCmuAndTheOnlyAsf) {
  const auto amc = ScratchDir() / "05_11.amc";
  EXPECT_THROW(FindAsfOf(amc), InputError);
  WriteScratch("other.asf", "");
  EXPECT_EQ(FindAsfOf(amc), ScratchDir() / "other.asf");
  WriteScratch("third.asf", "");
  EXPECT_THROW(FindAsfOf(amc), InputError);
  WriteScratch("05.asf", "");
  EXPECT_EQ(FindAsfOf(amc), ScratchDir() / "05.asf");
}

TEST(ReadAmc, RefusesMalformedFilesNamingTheLine) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("m_1.amc:1: the file ends before its first frame"));
  EXPECT_THAT(ErrorOf(":DEGREES\n"), HasSubstr("before its first frame"));
  EXPECT_THAT(ErrorOf("root 0 0 0 0 0 0\n"), HasSubstr("m_1.amc:1: found \"root\""));
  EXPECT_THAT(ErrorOf("1\n"), HasSubstr("found 0 bones in frame 1"));
  EXPECT_THAT(ErrorOf("1\nltibia 1 2\n"), HasSubstr("m_1.amc:2: found \"2\""));
  EXPECT_THAT(ErrorOf("1\nltibia\n"), HasSubstr("m_1.amc:2: found the end of the line"));
  EXPECT_THAT(ErrorOf("1\ntail 1\n"), HasSubstr("m_1.amc:2: found \"tail\", wanted a bone"));
  EXPECT_THAT(ErrorOf("1\nltibia 1\nltibia 1\n"), HasSubstr("m_1.amc:3: found \"ltibia\""));
  EXPECT_THAT(ErrorOf("1\nltibia nan\n"), HasSubstr("m_1.amc:2: found \"nan\""));
  EXPECT_THAT(ErrorOf("1\nltibia 1e999\n"), HasSubstr("m_1.amc:2: "));
  EXPECT_THAT(ErrorOf("1\nltibia 1\n3\nltibia 1\n"),
              HasSubstr("m_1.amc:3: found \"3\", wanted frame"));
  EXPECT_THAT(ErrorOf("99999999999\nltibia 1\n"), HasSubstr("m_1.amc:1: "));
  EXPECT_THAT(ErrorOf("1\nroot 0 0 0 0 0 0\nltibia 1\n2\nroot 0 0 0 0 0 0\n"),
              HasSubstr("m_1.amc:4: found 1 bones in frame 2, wanted 2"));
}

}  // namespace
}  // namespace poselift
