// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The program itself, run on a made-up walk as a motion file and as poses:
// smooth and plot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "lift/poses_to_motion.h"
#include "src/io/motion_file.h"
#include "src/io/poses_json.h"
#include "tests/support/broken_input.h"
#include "tests/support/mutation.h"
#include "tests/support/planted_walk.h"
#include "tests/support/rig_skeleton.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using nlohmann::json;
using testing::ExpectRefusal;
using testing::FileText;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ProgramRun;
using testing::RunProgram;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

// walk.bvh, 60 Hz, with noise.
Motion WriteWalk(int num_frames) {
  auto rng = TestRng();
  std::normal_distribution<double> normal(0.0, 0.02);
  Motion motion = testing::PlantWalk(num_frames, 0.6, 0.0).motion;
  for (SkeletonPose& pose : motion.frames)
    for (double& dof : pose.dofs) dof += normal(rng);
  WriteMotion(motion, ScratchDir() / "walk.bvh");
  return motion;
}

// poses.json of the walk before a camera; frames 5 to 7 and 15 to 29 missing.
void WritePoses() {
  PosesMotion source;
  source.motion = testing::PlantWalk(40, 0.6, 0.0).motion;
  source.camera.scale_px_per_m.assign(40, 150.0);
  source.camera.centre_px = {320.0, 240.0};
  for (int t = 0; t < 40; ++t) source.times_s.push_back(t / 30.0);
  Poses poses = MotionToPoses(source.motion, source, std::vector<std::string>(40, "ok"));
  for (int t = 0; t < 40; ++t)
    if ((t >= 5 && t <= 7) || (t >= 15 && t <= 29)) poses.frames[t].people.clear();
  WritePosesJson(poses, ScratchDir() / "poses.json");
}

json Report() { return json::parse(FileText(ScratchDir() / "report.json")); }

TEST(Smooth, TakesTheJitterOutOfAMotionFile) {
  WriteWalk(90);
  const ProgramRun run = RunProgram("smooth walk.bvh --out smooth.bvh --json report.json");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("walk.bvh: 90 frames at 60 Hz, 1.5 s"));
  EXPECT_THAT(run.out, HasSubstr("motion model of"));
  const json report = Report();
  EXPECT_EQ(report["frames"], 90);
  EXPECT_EQ(report["method"], "auto");
  EXPECT_LT(report["jitter_after_mm"].get<double>(),
            0.3 * report["jitter_before_mm"].get<double>());
  EXPECT_TRUE(report["filled"].empty());
  EXPECT_FALSE(report.contains("feet"));
  EXPECT_EQ(ReadMotion(ScratchDir() / "smooth.bvh").frames.size(), 90u);
}

TEST(Smooth, ARigOfAnotherKindKeepsItsBonesAndChannels) {
  const Motion rig = testing::OnRig(testing::PlantWalk(60, 0.6, 0.0).motion);
  WriteMotion(rig, ScratchDir() / "rig.bvh");
  const ProgramRun run = RunProgram("smooth rig.bvh --out smooth.bvh --json report.json");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("motion model of"));
  const std::string before = FileText(ScratchDir() / "rig.bvh");
  const std::string after = FileText(ScratchDir() / "smooth.bvh");
  EXPECT_EQ(after.substr(0, after.find("MOTION")), before.substr(0, before.find("MOTION")));
  const json report = Report();
  EXPECT_LT(report["jitter_after_mm"].get<double>(),
            0.5 * report["jitter_before_mm"].get<double>());
  EXPECT_EQ(ReadMotion(ScratchDir() / "smooth.bvh").frames.size(), 60u);
}

TEST(Smooth, WhatIsNoBodyIsFilteredAndSaidSo) {
  WriteWalk(40);
  WriteScratch("crane.bvh",
               testing::Replaced(FileText(ScratchDir() / "walk.bvh"), "rtibia", "jib"));
  const ProgramRun run = RunProgram("smooth crane.bvh --out smooth.bvh");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Butterworth filter"));
  EXPECT_THAT(run.out, HasSubstr("no motion model: found no bone for right_knee"));
  ExpectRefusal("smooth crane.bvh --method motion-model --out s.bvh",
                "found no bone for right_knee");
}

TEST(Smooth, EveryMethodRunsAndTheSameBytesComeOut) {
  WriteWalk(40);
  std::vector<std::string> results;
  for (const char* method : {"butterworth --cutoff-hz 3", "savitzky-golay --window-frames 5",
                             "one-euro --beta 1", "linear", "spline"}) {
    const std::string command = std::string("smooth walk.bvh --method ") + method + " --out ";
    EXPECT_EQ(RunProgram(command + "a.bvh").code, 0) << method;
    EXPECT_EQ(RunProgram(command + "b.bvh").code, 0);
    EXPECT_EQ(FileText(ScratchDir() / "a.bvh"), FileText(ScratchDir() / "b.bvh"));
    results.push_back(FileText(ScratchDir() / "a.bvh"));
  }
  EXPECT_NE(results[0], results[1]);
  EXPECT_NE(results[1], results[2]);
  EXPECT_NE(results[2], results[3]);
}

TEST(Smooth, PosesHaveTheirGapsFilledAndMarked) {
  WritePoses();
  const ProgramRun run =
      RunProgram("smooth poses.json --out smooth.json --max-gap-s 0.2 --json report.json");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("filled frames: 5-7 (0.1 s)"));
  EXPECT_THAT(run.out, HasSubstr("15-29 (0.5 s)"));
  const json report = Report();
  EXPECT_EQ(report["filled"],
            json({{{"first", 5}, {"last", 7}, {"seconds", report["filled"][0]["seconds"]}}}));
  EXPECT_EQ(report["not_known"][0]["first"], 15);
  const Poses smooth = ReadPosesJson(ScratchDir() / "smooth.json");
  ASSERT_EQ(smooth.frames.size(), 40u);
  for (int t = 0; t < 40; ++t) {
    const std::string status = t >= 5 && t <= 7     ? "filled"
                               : t >= 15 && t <= 29 ? "not known"
                                                    : "ok";
    EXPECT_EQ(smooth.frames[t].people[0].status, status) << t;
    EXPECT_NEAR(*smooth.frames[t].time_s, t / 30.0, 1e-3);
  }
  EXPECT_NEAR(smooth.frames[6].people[0].scale_px_per_m, 150.0, 1e-6);
}

TEST(Smooth, PosesBecomeAMotionFileWithEveryFrame) {
  WritePoses();
  EXPECT_EQ(RunProgram("smooth poses.json --out out.bvh --person 0 --lock-feet").code, 0);
  const Motion motion = ReadMotion(ScratchDir() / "out.bvh");
  EXPECT_EQ(motion.frames.size(), 40u);
  EXPECT_NEAR(motion.frame_time_s, 1.0 / 30.0, 1e-4);
}

TEST(Smooth, LocksFeet) {
  WriteWalk(120);
  EXPECT_EQ(RunProgram("smooth walk.bvh --out s.bvh --lock-feet --json report.json").code, 0);
  const json feet = Report()["feet"];
  EXPECT_GE(feet["contacts"], 3);
  EXPECT_EQ(feet["failures"], 0);
  EXPECT_LT(feet["slide_after_mm"].get<double>(), 2.5);
  EXPECT_LT(feet["slide_after_mm"].get<double>(), 0.5 * feet["slide_before_mm"].get<double>());
}

TEST(Smooth, SlowCamerasHaveALowerCutoff) {
  WriteWalk(40);
  const ProgramRun run = RunProgram("smooth walk.bvh --method butterworth --fps 10 --out s.bvh");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("cutoff 2.5 Hz (a quarter of the frame rate)"));
  ExpectRefusal("smooth walk.bvh --method butterworth --fps 10 --cutoff-hz 6 --out t.bvh",
                "cutoff");
}

TEST(Smooth, SaysWhatIsWrongWithItsExitCode) {
  WriteWalk(10);
  WritePoses();
  EXPECT_EQ(RunProgram("smooth walk.bvh").code, 2);
  EXPECT_EQ(RunProgram("smooth walk.bvh --out s.bvh --method best").code, 2);
  EXPECT_EQ(RunProgram("smooth walk.bvh --out s.bvh --cutoff-hz nan").code, 2);
  EXPECT_EQ(RunProgram("smooth walk.bvh --out s.bvh --max-gap-s -1").code, 2);
  ExpectRefusal("smooth absent.bvh --out s.bvh", "absent.bvh");
  ExpectRefusal("smooth walk.bvh --out s.xyz", "s.xyz");
  ExpectRefusal("smooth walk.bvh --out s.bvh --method savitzky-golay --window-frames 4", "window");
  ExpectRefusal("smooth poses.json --out s.bvh --person 7", "poses.json: found no person 7");
  WriteScratch("timeless.json",
               testing::Replaced(FileText(ScratchDir() / "poses.json"), "\"time_s\"", "\"was\""));
  ExpectRefusal("smooth timeless.json --out s.bvh", "frames[0]: found no time_s");
}

TEST(Plot, DrawsTheAnglesOfMotionsAndPoses) {
  WriteWalk(60);
  WritePoses();
  EXPECT_EQ(RunProgram("smooth poses.json --out smooth.json").code, 0);
  const ProgramRun run = RunProgram(
      "plot walk.bvh smooth.json --angles left_knee.flexion,right_hip.flexion --contacts --out "
      "a.svg");
  EXPECT_EQ(run.code, 0) << run.err;
  const std::string svg = FileText(ScratchDir() / "a.svg");
  for (const char* text : {">walk.bvh, smooth.json<", ">left_knee.flexion, walk.bvh<",
                           ">right_hip.flexion, smooth.json<", ">filled<", ">left foot<"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(Plot, AnUnknownAngleIsRefusedWithTheNearestNames) {
  WriteWalk(3);
  const ProgramRun run = RunProgram("plot walk.bvh --angles left_kne.flexion --out a.svg");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("left_kne.flexion"));
  EXPECT_THAT(run.err, HasSubstr("perhaps left_knee.flexion"));
  EXPECT_EQ(RunProgram("plot walk.bvh --out a.svg").code, 2);
  EXPECT_EQ(RunProgram("plot walk.bvh walk.bvh walk.bvh walk.bvh walk.bvh --out a.svg --angles "
                       "left_knee.flexion,right_knee.flexion")
                .code,
            2);
  ExpectRefusal("plot absent.bvh --angles left_knee.flexion --out a.svg", "absent.bvh");
}

// The frames of poses.json, a line each.
std::string WriteLines() {
  WritePoses();
  const json poses = json::parse(FileText(ScratchDir() / "poses.json"));
  std::string lines;
  for (const json& frame : poses["frames"]) lines += frame.dump() + "\n";
  return WriteScratch("poses.jsonl", lines);
}

TEST(SmoothStream, JsonLinesComeOutInOrderWithGapsMarked) {
  WriteLines();
  const ProgramRun run =
      RunProgram("smooth poses.jsonl --out smooth.jsonl --latency-s 0.1 --max-gap-s 0.2");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr("40 frames, 0.1 s late; 9 filled, 9 not known"));
  std::istringstream lines(FileText(ScratchDir() / "smooth.jsonl"));
  std::string line;
  for (int t = 0; t < 40; ++t) {
    ASSERT_TRUE(std::getline(lines, line)) << t;
    const FramePoses frame = ReadFramePosesLine(line, "smooth.jsonl", t + 1);
    EXPECT_NEAR(*frame.time_s, t / 30.0, 1e-6);
    const PersonPose& person = frame.people.at(0);
    EXPECT_EQ(person.status, (t >= 5 && t <= 7) || (t >= 15 && t <= 20) ? "filled"
                             : t >= 21 && t <= 29                       ? "not known"
                                                                        : "ok")
        << t;
    if (person.status != "not known") {
      EXPECT_NEAR(person.scale_px_per_m, 150.0, 1e-6);
      EXPECT_TRUE(person.joints_in_cam_m.allFinite());
    }
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(SmoothStream, ALineThatIsWrongIsNamed) {
  std::string lines = FileText(WriteLines());
  const size_t third = lines.find('\n', lines.find('\n') + 1) + 1;
  WriteScratch("broken.jsonl", lines.substr(0, third) + "{\"people\": 3}\n");
  ExpectRefusal("smooth broken.jsonl --out out.jsonl", "broken.jsonl:3");
  WriteScratch("back.jsonl", lines.substr(0, third) + lines.substr(0, third));
  ExpectRefusal("smooth back.jsonl --out out.jsonl", "back.jsonl:3");
  WriteScratch("timeless.jsonl", "{\"people\": []}\n");
  ExpectRefusal("smooth timeless.jsonl --out out.jsonl", "wanted its time, or the rate (--fps)");
  EXPECT_EQ(RunProgram("smooth timeless.jsonl --out out.jsonl --fps 30").code, 0);
  ExpectRefusal("smooth absent.jsonl --out out.jsonl", "cannot be opened");
}

TEST(SmoothStream, WhatLooksAtAllFramesIsRefused) {
  WriteLines();
  ExpectRefusal("smooth poses.jsonl --out out.jsonl --method butterworth",
                "wanted online, or auto");
  ExpectRefusal("smooth poses.jsonl --out out.bvh", "for both or for neither");
  ExpectRefusal("smooth poses.jsonl --out out.jsonl --lock-feet", "--lock-feet");
}

TEST(Smooth, OnlineIsAMethodForFilesToo) {
  WritePoses();
  const ProgramRun run = RunProgram("smooth poses.json --out out.json --method online");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("from earlier frames and 0.1 s of later ones"));
}

}  // namespace
}  // namespace poselift
