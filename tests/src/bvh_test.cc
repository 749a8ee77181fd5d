// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// BVH files through the real file system: what channels mean, the T-pose of what
// we write, inverse pairs on random motions, a golden file, malformed files.
// POSELIFT_UPDATE_GOLDEN=1 rewrites the golden file.
#include "src/io/bvh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/asf.h"
#include "src/io/bvh_rig.h"
#include "src/io/text_scanner.h"
#include "src/retarget.h"
#include "src/units.h"
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

// 0, 1, 2, 3 and 6 channels; tabs, blanks, a brace on the line of its joint, a
// name of two words.
constexpr std::string_view kMixedBvh = R"(HIERARCHY
ROOT Hips
{
	OFFSET 1 2 3
	CHANNELS 4 Yposition Zrotation Xrotation Yrotation
	JOINT Left Up Leg {
		OFFSET	10 0 0
		CHANNELS 1 Xrotation
		JOINT Knee
		{
			OFFSET 0 -40 0
			CHANNELS 6 Xposition Yposition Zposition Yrotation Zrotation Xrotation
			End Site
			{
				OFFSET 0 -4e1 0
			}
		}
	}
	JOINT Spine
	{
		OFFSET 0 10 0
		CHANNELS 2 Xrotation Zrotation
		JOINT Fixed
		{
			OFFSET 0 20 0
			CHANNELS 0
			End Site
			{
				OFFSET 0 5 0
			}
		}
	}
}
MOTION
Frames: 2
Frame Time: .0083333
90 0 0 0 0  0 -40 0 0 0 0  0 0
90 10 20 30 -30  1 -42 3 40 50 60  70 80
)";

Motion ReadText(const std::string& text) { return ReadBvh(WriteScratch("m.bvh", text)); }

std::string ErrorOf(const std::string& text) {
  try {
    ReadText(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string Replaced(std::string_view from, std::string_view to) {
  std::string text(kMixedBvh);
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Skeleton MadeUp() { return ReadAsf(WriteScratch("m.asf", std::string(kMadeUpAsf))); }

Eigen::Matrix3d Turn(int axis, double angle_deg) {
  return Eigen::AngleAxisd(angle_deg * kRadFromDeg, Eigen::Vector3d::Unit(axis)).matrix();
}

TEST(ReadBvh, MeansEveryChannelInItsOrder) {
  const Motion motion = ReadText(std::string(kMixedBvh));
  ASSERT_EQ(motion.frames.size(), 2u);
  EXPECT_EQ(motion.frame_time_s, .0083333);
  ASSERT_EQ(motion.skeleton.bones.size(), 5u);
  EXPECT_EQ(motion.skeleton.bones[1].name, "Left_Up_Leg");
  BoneFrames frames;
  ForwardKinematics(motion.skeleton, motion.frames[1], &frames);
  // By hand, in cm.
  const Eigen::Matrix3d hips = Turn(2, 10) * Turn(0, 20) * Turn(1, 30);
  const Eigen::Vector3d root(1, 90, 3);  // x and z have no channel: the OFFSET
  const Eigen::Matrix3d thigh = hips * Turn(0, -30);
  const Eigen::Vector3d thigh_start = root + hips * Eigen::Vector3d(10, 0, 0);
  const Eigen::Vector3d knee_start = thigh_start + thigh * Eigen::Vector3d(1, -42, 3);
  const Eigen::Matrix3d knee = thigh * Turn(1, 40) * Turn(2, 50) * Turn(0, 60);
  const Eigen::Matrix3d spine = hips * Turn(0, 70) * Turn(2, 80);
  const Eigen::Vector3d spine_start = root + hips * Eigen::Vector3d(0, 10, 0);
  EXPECT_TRUE(MatrixNear(frames.start_in_world_m.col(0), root / 100, 1e-12));
  EXPECT_TRUE(MatrixNear(frames.start_in_world_m.col(2), knee_start / 100, 1e-12));
  EXPECT_TRUE(MatrixNear(frames.tip_in_world_m.col(2),
                         (knee_start + knee * Eigen::Vector3d(0, -40, 0)) / 100, 1e-12));
  EXPECT_TRUE(MatrixNear(frames.tip_in_world_m.col(4),
                         (spine_start + spine * Eigen::Vector3d(0, 25, 0)) / 100, 1e-12));
  // The tip of a bone is its only child's place, or the middle of its children's.
  EXPECT_EQ(motion.skeleton.bones[1].tip_m, Eigen::Vector3d(0, -0.4, 0));
  EXPECT_TRUE(MatrixNear(motion.skeleton.bones[0].tip_m, Eigen::Vector3d(0.05, 0.05, 0), 1e-15));
}

TEST(ReadBvh, TakesCarriageReturnsUnitsAndNoFrameTime) {
  std::string text = Replaced("Frame Time: .0083333\n", "");
  for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\r\n");
  const Motion motion =
      ReadBvh(WriteScratch("m.bvh", text), {.metres_per_unit = 1.0, .frame_time_s = 0.25});
  EXPECT_EQ(motion.frame_time_s, 0.25);
  EXPECT_EQ(motion.skeleton.bones[2].offset_m.y(), -40.0);
}

TEST(WriteBvh, KeepsEveryBoneOfAnyBvh) {
  const Motion motion = ReadText(std::string(kMixedBvh));
  for (const double metres_per_unit : {1.0, 0.01, 0.001, 0.0254}) {
    WriteBvh(motion, ScratchDir() / "b.bvh", {metres_per_unit});
    ExpectSamePlaces(motion, ReadBvh(ScratchDir() / "b.bvh", {metres_per_unit}), 1e-7);
  }
}

TEST(WriteBvh, TakesAnAsfMotionThereAndBack) {
  auto rng = TestRng();
  const Skeleton skeleton = MadeUp();
  for (int trial = 0; trial < 20; ++trial) {
    const Motion motion = RandomMotion(skeleton, 40, &rng);
    WriteBvh(motion, ScratchDir() / "b.bvh");
    const Motion bvh = ReadBvh(ScratchDir() / "b.bvh");
    ExpectSamePlaces(motion, bvh, 1e-7);
    RebaseReport report;
    ExpectSamePlaces(motion, RebaseMotion(bvh, skeleton, &report), 1e-6);
    EXPECT_TRUE(report.bones_at_rest.empty());
    EXPECT_LT(report.worst_rotation_rad * kDegFromRad, 1e-4);
  }
}

TEST(GrowingBvh, IsTheFileOfItsPosesSoFar) {
  auto rng = TestRng();
  const Motion motion = RandomMotion(MadeUp(), 12, &rng);
  const auto path = ScratchDir() / "g.bvh";
  GrowingBvh growing(path, motion.skeleton, motion.frame_time_s);
  Motion so_far{motion.skeleton, motion.frame_time_s, {}};
  for (const SkeletonPose& pose : motion.frames) {
    growing.Add(pose);
    so_far.frames.push_back(pose);
    WriteBvh(so_far, ScratchDir() / "b.bvh");
    std::string wanted = ReadTextFile(ScratchDir() / "b.bvh");
    const std::string count = std::to_string(so_far.frames.size());
    const size_t at = wanted.find("Frames: ") + 8;
    wanted.insert(at + count.size(), 10 - count.size(), ' ');
    ASSERT_EQ(ReadTextFile(path), wanted);
    EXPECT_EQ(ReadBvh(path).frames.size(), so_far.frames.size());
  }
  EXPECT_THROW(growing.Add(UnknownPose(motion.skeleton)), std::invalid_argument);
  SkeletonPose far = motion.frames[0];
  far.root_in_world_m.z() = 1e12;
  EXPECT_THROW(growing.Add(far), InputError);
  growing.Add(motion.frames[0]);
  growing.Close();
  EXPECT_EQ(ReadBvh(path).frames.size(), 13u);
  EXPECT_THROW(GrowingBvh(path, motion.skeleton, 0.0), InputError);
}

TEST(BvhRig, RestsInATPoseWithoutTheHipBones) {
  const BvhRig rig = MakeBvhRig(MadeUp());
  EXPECT_FALSE(rig.skeleton.FindBone("lhipjoint"));
  BoneFrames frames;
  ForwardKinematics(rig.skeleton, SkeletonPose::Rest(rig.skeleton), &frames);
  const auto direction = [&](const char* name) {
    const int b = *rig.skeleton.FindBone(name);
    return (frames.tip_in_world_m.col(b) - frames.start_in_world_m.col(b)).normalized().eval();
  };
  EXPECT_TRUE(MatrixNear(direction("lfemur"), -Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(MatrixNear(direction("ltibia"), -Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(MatrixNear(direction("rwrist"), -Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE(MatrixNear(direction("ltoes"), Eigen::Vector3d::UnitZ(), 1e-12));
  // The foot stands to the shank as before: the same angle, not turned in or out.
  EXPECT_NEAR(direction("lfoot").y(),
              -Eigen::Vector3d(0.34202, -0.939693, 0)
                   .normalized()
                   .dot(Eigen::Vector3d(0.09, -0.25, 0.96).normalized()),
              1e-9);
  EXPECT_NEAR(direction("lfoot").x(), 0.0, 0.01);
}

TEST(BvhRig, KeepsBonesWithoutDofsThatPeopleAnimate) {
  Skeleton skeleton;
  skeleton.bones = {{.name = "root"},
                    {.name = "lclavicle", .parent = 0, .tip_m = {1, 0, 0}},
                    {.name = "arm", .parent = 1, .offset_m = {1, 0, 0}, .tip_m = {1, 0, 0}},
                    {.name = "tailjoint", .parent = 0, .tip_m = {0, 0, -1}}};
  const BvhRig rig = MakeBvhRig(skeleton);
  EXPECT_EQ(rig.skeleton.bones.size(), 4u);  // a leaf carries no offset of a child
  EXPECT_EQ(rig.skeleton.bones[1].dofs.size(), 3u);
}

TEST(WriteBvh, CleansNamesThatReadersRefuse) {
  Skeleton skeleton;
  skeleton.bones = {{.name = "Hips", .tip_m = {0, 1, 0}},
                    {.name = "left arm", .parent = 0, .tip_m = {1, 0, 0}},
                    {.name = "left_arm", .parent = 0, .tip_m = {1, 0, 0}},
                    {.name = "h\xC3\xA4nd", .parent = 1, .offset_m = {1, 0, 0}}};
  WriteBvh({skeleton, 0.1, {SkeletonPose::Rest(skeleton)}}, ScratchDir() / "n.bvh");
  const Skeleton again = ReadBvh(ScratchDir() / "n.bvh").skeleton;
  EXPECT_EQ(again.bones[1].name, "left_arm");
  EXPECT_EQ(again.bones[2].name, "h__nd");
  EXPECT_EQ(again.bones[3].name, "left_arm_2");
}

TEST(WriteBvh, WritesTheGoldenFile) {
  Skeleton skeleton;
  skeleton.bones = {
      {.name = "Hips"},
      {.name = "Spine", .parent = 0, .tip_m = {0, 0.5, 0}, .dofs = {{Dof::Kind::kRx}}},
      {.name = "LeftUpLeg",
       .parent = 0,
       .offset_m = {0.1, 0, 0},
       .tip_m = {0, -0.4, 0},
       .dofs = {{Dof::Kind::kRx}, {Dof::Kind::kTy}, {Dof::Kind::kRz}}},
      {.name = "LeftLeg",
       .parent = 2,
       .offset_m = {0, -0.4, 0},
       .tip_m = {0, -0.35, 0.01},
       .dofs = {{Dof::Kind::kRx}}}};
  Motion motion{skeleton, 1.0 / 30.0, {}};
  for (int f = 0; f < 3; ++f) {
    SkeletonPose pose = SkeletonPose::Rest(skeleton);
    pose.root_in_world_m = {0.1 * f, 0.9, -0.05};
    pose.world_from_root = Eigen::AngleAxisd(1.5 * f, Eigen::Vector3d::UnitY());
    pose.dofs << 0.1 * f, 0.2, 0.01 * f, -0.3, 0.5 * f;
    motion.frames.push_back(pose);
  }
  WriteBvh(motion, ScratchDir() / "golden.bvh");
  const std::string text = ReadTextFile(ScratchDir() / "golden.bvh");
  const auto golden = testing::SourcePath("tests/golden/leg.bvh");
  if (std::getenv("POSELIFT_UPDATE_GOLDEN")) std::ofstream(golden) << text;
  EXPECT_EQ(text, ReadTextFile(golden));
}

TEST(WriteBvh, RefusesWhatIsNoMotion) {
  const Skeleton skeleton = MadeUp();
  Motion motion{skeleton, 0.1, {SkeletonPose::Rest(skeleton)}};
  motion.frames[0].root_in_world_m.x() = std::nan("");
  EXPECT_THROW(WriteBvh(motion, ScratchDir() / "x.bvh"), InputError);
  motion.frames[0].root_in_world_m.x() = HUGE_VAL;
  EXPECT_THROW(WriteBvh(motion, ScratchDir() / "x.bvh"), InputError);
  motion.frames[0] = SkeletonPose::Rest(skeleton);
  motion.frames[0].dofs[2] = std::nan("");
  EXPECT_THROW(WriteBvh(motion, ScratchDir() / "x.bvh"), InputError);
  motion.frames[0] = SkeletonPose::Rest(skeleton);
  motion.frame_time_s = 0.0;
  EXPECT_THROW(WriteBvh(motion, ScratchDir() / "x.bvh"), InputError);
  EXPECT_FALSE(std::filesystem::exists(ScratchDir() / "x.bvh"));
}

TEST(ReadBvh, RefusesMalformedFilesNamingTheLine) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("m.bvh:1: the file ends here, wanted HIERARCHY"));
  EXPECT_THAT(ErrorOf("hello"), HasSubstr("m.bvh:1: found \"hello\", wanted HIERARCHY"));
  EXPECT_THAT(ErrorOf("HIERARCHY\nROOT a\n{\n"), HasSubstr("the file ends here"));
  EXPECT_THAT(ErrorOf(Replaced("ROOT Hips", "ROOT")), HasSubstr("m.bvh:2: "));
  EXPECT_THAT(ErrorOf(Replaced("OFFSET 1 2 3", "OFFSET 1 2")), HasSubstr("m.bvh:4: "));
  EXPECT_THAT(ErrorOf(Replaced("OFFSET 1 2 3", "OFFSET 1 2 3 4")),
              HasSubstr("m.bvh:4: found \"4\""));
  EXPECT_THAT(ErrorOf(Replaced("OFFSET 1 2 3", "OFFSET 1 nan 3")), HasSubstr("found \"nan\""));
  EXPECT_THAT(ErrorOf(Replaced("OFFSET 1 2 3", "OFFSET 1,5 2 3")), HasSubstr("found \"1,5\""));
  EXPECT_THAT(ErrorOf(Replaced("OFFSET 1 2 3", "")), HasSubstr("an OFFSET for every joint"));
  EXPECT_THAT(ErrorOf(Replaced("CHANNELS 4", "CHANNELS 3")), HasSubstr("m.bvh:5: "));
  EXPECT_THAT(ErrorOf(Replaced("CHANNELS 4", "CHANNELS 1000000000")), HasSubstr("wanted 0 to 6"));
  EXPECT_THAT(ErrorOf(Replaced("Yposition", "Wposition")), HasSubstr("found \"Wposition\""));
  EXPECT_THAT(ErrorOf(Replaced("Yposition", "Zrotation")), HasSubstr("every channel once"));
  EXPECT_THAT(ErrorOf(Replaced("MOTION", "}")), HasSubstr("wanted MOTION"));
  EXPECT_THAT(ErrorOf(Replaced("Frames: 2", "Frames: 3")),
              HasSubstr("found \"Frames: 3\" and 2 lines of values"));
  EXPECT_THAT(ErrorOf(Replaced("Frames: 2", "Frames: 1")), HasSubstr("and 2 lines"));
  EXPECT_THAT(ErrorOf(Replaced("Frames: 2", "Frames: 999999999")), HasSubstr("and 2 lines"));
  EXPECT_THAT(ErrorOf(Replaced("Frames: 2\n", "")), HasSubstr("no line \"Frames: N\""));
  EXPECT_THAT(ErrorOf(Replaced(".0083333", "0")), HasSubstr("frame time"));
  EXPECT_THAT(ErrorOf(Replaced(".0083333", "-1")), HasSubstr("frame time"));
  EXPECT_THAT(ErrorOf(Replaced("70 80\n", "70\n")),
              HasSubstr("m.bvh:38: found the end of the line, wanted a value for each of the 13"));
  EXPECT_THAT(ErrorOf(Replaced("70 80\n", "70 80 90\n")), HasSubstr("m.bvh:38: found \"90\""));
  EXPECT_THAT(ErrorOf(Replaced("70 80\n", "70 inf\n")), HasSubstr("m.bvh:38: found \"inf\""));
  EXPECT_THAT(ErrorOf("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\nFrames: 1000000\n"),
              HasSubstr("no channels"));
}

TEST(ReadBvh, SurvivesEveryTruncationAndAnyDepth) {
  const std::string text(kMixedBvh);
  for (size_t length = 0; length < text.size(); length += 5) {
    try {
      ReadText(text.substr(0, length));
    } catch (const InputError&) {
    }
  }
  std::string deep = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
  for (int i = 0; i < 20000; ++i) deep += "JOINT b\n{\nOFFSET 0 1 0\n";
  for (int i = 0; i <= 20000; ++i) deep += "}\n";
  EXPECT_EQ(ReadText(deep + "MOTION\nFrames: 1\n5\n").skeleton.bones.size(), 20001u);
}

}  // namespace
}  // namespace poselift
