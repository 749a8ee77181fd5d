// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The program itself, run on made-up files: convert.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "src/io/amc.h"
#include "src/io/bvh.h"
#include "src/io/motion_file.h"
#include "src/io/text_scanner.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ExpectSamePlaces;
using ::testing::HasSubstr;
using testing::kMadeUpAsf;
using testing::ProgramRun;
using testing::RandomMotion;
using testing::RunProgram;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

Motion WriteMadeUpMotion() {
  auto rng = TestRng();
  const AsfSkeleton asf = ReadAsfSkeleton(WriteScratch("09.asf", std::string(kMadeUpAsf)));
  Motion motion = RandomMotion(asf.skeleton, 12, &rng);
  motion.frame_time_s = kCmuFrameTime_s;
  WriteAmc(motion, asf, ScratchDir() / "09_01.amc");
  return motion;
}

TEST(Convert, TakesAnAmcToBvhAndBackOnItsSkeleton) {
  const Motion motion = WriteMadeUpMotion();
  const ProgramRun there = RunProgram("convert 09_01.amc a.bvh --units m");
  EXPECT_EQ(there.code, 0) << there.err;
  EXPECT_THAT(there.err, HasSubstr("lengths in m; to have metres, import it with scale 1"));
  ExpectSamePlaces(motion, ReadBvh(ScratchDir() / "a.bvh", {.metres_per_unit = 1.0}), 1e-6);
  const ProgramRun back = RunProgram("convert a.bvh b.amc --units m --skeleton 09.asf");
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_FALSE(std::filesystem::exists(ScratchDir() / "b.asf"));
  ExpectSamePlaces(motion,
                   ReadMotion(ScratchDir() / "b.amc", {.skeleton = ScratchDir() / "09.asf"}), 1e-6);
}

TEST(Convert, WritesTheAsfBesideAnAmcWithoutOne) {
  const Motion motion = WriteMadeUpMotion();
  EXPECT_EQ(RunProgram("convert 09_01.amc a.bvh").code, 0);
  EXPECT_EQ(RunProgram("convert a.bvh own.amc").code, 0);
  EXPECT_TRUE(std::filesystem::exists(ScratchDir() / "own.asf"));
  ExpectSamePlaces(motion, ReadMotion(ScratchDir() / "own.amc"), 1e-6);
}

TEST(Convert, ChangesUnitsAndTheRate) {
  WriteMadeUpMotion();
  EXPECT_EQ(RunProgram("convert 09_01.amc mm.bvh --units mm --fps 50").code, 0);
  EXPECT_EQ(RunProgram("convert mm.bvh in.bvh --input-units mm --units in").code, 0);
  const Motion mm = ReadMotion(ScratchDir() / "mm.bvh", {.metres_per_unit = 0.001});
  EXPECT_NEAR(mm.frame_time_s, 0.02, 1e-12);
  ExpectSamePlaces(mm, ReadMotion(ScratchDir() / "in.bvh", {.metres_per_unit = 0.0254}), 1e-6);
}

TEST(Convert, SaysWhatIsWrongWithItsExitCode) {
  WriteMadeUpMotion();
  EXPECT_EQ(RunProgram("convert").code, 2);
  EXPECT_EQ(RunProgram("convert 09_01.amc a.bvh --units miles").code, 2);
  EXPECT_EQ(RunProgram("convert 09_01.amc a.bvh --fps 0").code, 2);
  EXPECT_EQ(RunProgram("convert absent.amc a.bvh --skeleton 09.asf").code, 3);
  EXPECT_EQ(RunProgram("convert 09_01.amc a.xyz").code, 3);
  EXPECT_EQ(RunProgram("convert 09_01.amc no/such/folder/a.bvh").code, 3);
  WriteScratch("other.bvh",
               "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\nMOTION\n"
               "Frames: 1\nFrame Time: 1\n5\n");
  const ProgramRun outcome = RunProgram("convert other.bvh b.amc --skeleton 09.asf");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("no bone that the motion has too"));
}

}  // namespace
}  // namespace poselift
