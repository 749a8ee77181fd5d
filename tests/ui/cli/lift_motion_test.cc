// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The labels of the sample walk through the program, as a user would: a real walk,
// so what is tested is what one sees of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/io/labels.h"
#include "src/io/motion_file.h"
#include "tests/support/mutation.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::RunProgram;
using testing::ScratchDir;
using Json = nlohmann::json;

const std::filesystem::path kWalk =
    std::filesystem::path(POSELIFT_SOURCE_DIR) / "samples/walk/walk-side.every-frame.labels.json";

// `count` frames of the walk from its 40th on, in this test's folder.
Labels PartOfWalk(size_t count) {
  Labels labels = ReadLabels(kWalk, "auto");
  labels.frames = {labels.frames.begin() + 40,
                   labels.frames.begin() + 40 + static_cast<std::ptrdiff_t>(count)};
  return labels;
}

Json ReadJson(const std::string& path) { return Json::parse(std::ifstream(ScratchDir() / path)); }

std::vector<double> Angles(const Json& poses, const char* name) {
  std::vector<double> angles_deg;
  for (const Json& frame : poses["frames"])
    angles_deg.push_back(frame["people"][0]["angles_deg"][name].get<double>());
  return angles_deg;
}

TEST(LiftMotion, KneesBendOneAfterTheOtherAndTheRightWay) {
  ASSERT_EQ(RunProgram("lift --labels " + kWalk.string() + " --out out").code, 0);
  const Motion motion = ReadMotion(ScratchDir() / "out/poses.bvh");
  EXPECT_NEAR(motion.frame_time_s, 1.0 / 30.0, 1e-4);
  Json poses = ReadJson("out/poses.json");
  // Frames in which she is in the picture as a whole.
  auto& frames = poses["frames"];
  frames.erase(frames.begin() + 150, frames.end());
  frames.erase(frames.begin(), frames.begin() + 30);
  const auto left = Angles(poses, "left_knee.flexion"), right = Angles(poses, "right_knee.flexion");
  int swings = 0;
  bool was_left = left[0] > right[0];
  for (size_t t = 0; t < left.size(); ++t) {
    EXPECT_GT(std::min(left[t], right[t]), -5.0);
    EXPECT_LT(std::max(left[t], right[t]), 90.0);
    EXPECT_LT(std::abs(left[t] - left[t == 0 ? 0 : t - 1]), 12.0) << t;  // degrees a frame
    const bool is_clear = std::abs(left[t] - right[t]) > 25.0;
    if (!is_clear || was_left == (left[t] > right[t])) continue;
    was_left = !was_left;
    ++swings;
  }
  EXPECT_GE(swings, 5);  // four seconds of walking
  EXPECT_LE(swings, 8);
}

TEST(LiftMotion, FillsAndMarksFramesWithoutLabels) {
  Labels labels = PartOfWalk(16);
  for (const size_t t : {6, 7, 8}) labels.frames[t].people.clear();
  WriteLabels(labels, ScratchDir() / "gap.labels.json");
  const auto run = RunProgram("lift --labels gap.labels.json --out out");
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.out.find("3 of them from the frames around"), std::string::npos) << run.out;
  const Json poses = ReadJson("out/poses.json");
  for (size_t t = 0; t < 16; ++t)
    EXPECT_EQ(poses["frames"][t]["people"][0]["status"], t >= 6 && t <= 8 ? "filled" : "ok") << t;
  EXPECT_EQ(ReadMotion(ScratchDir() / "out/poses.bvh").frames.size(), 16U);
}

Eigen::VectorXd BvhLengths(const std::string& path) {
  const Motion motion = ReadMotion(ScratchDir() / path);
  Eigen::VectorXd lengths_m(motion.skeleton.bones.size());
  for (size_t b = 0; b < motion.skeleton.bones.size(); ++b)
    lengths_m[static_cast<Eigen::Index>(b)] = motion.skeleton.bones[b].tip_m.norm();
  return lengths_m;
}

TEST(LiftMotion, WritesTheBodyItFinds) {
  WriteLabels(PartOfWalk(40), ScratchDir() / "walk.labels.json");
  const auto run = RunProgram("lift --labels walk.labels.json --out own");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("person 0, bones at the standard stature: hip"), std::string::npos);
  const Json poses = ReadJson("own/poses.json");
  ASSERT_EQ(poses["bodies"].size(), 1U);
  const Json& lengths_m = poses["bodies"][0]["bone_lengths_m"];
  EXPECT_EQ(lengths_m["left_knee"], lengths_m["right_knee"]);
  const auto length_m = [](const Json& person, const char* joint, const char* parent) {
    const Json &a = person["joints_in_cam"][joint], &b = person["joints_in_cam"][parent];
    return std::hypot(a[0].get<double>() - b[0].get<double>(),
                      a[1].get<double>() - b[1].get<double>(),
                      a[2].get<double>() - b[2].get<double>());
  };
  for (const Json& frame : poses["frames"])
    EXPECT_NEAR(length_m(frame["people"][0], "left_knee", "left_hip"),
                lengths_m["left_knee"].get<double>(), 5e-6);

  // The motion file has this body, and so has what is smoothed of the poses.
  const Motion motion = ReadMotion(ScratchDir() / "own/poses.bvh");
  const auto thigh = motion.skeleton.FindBone("lfemur");
  ASSERT_TRUE(thigh.has_value());
  EXPECT_NEAR(motion.skeleton.bones[static_cast<size_t>(*thigh)].tip_m.norm(),
              lengths_m["left_knee"].get<double>(), 1e-5);
  ASSERT_EQ(RunProgram("smooth own/poses.json --out smooth.json").code, 0);
  EXPECT_EQ(ReadJson("smooth.json")["bodies"], poses["bodies"]);
  ASSERT_EQ(RunProgram("smooth own/poses.json --out smooth.bvh").code, 0);
  EXPECT_LT((BvhLengths("smooth.bvh") - BvhLengths("own/poses.bvh")).norm(), 1e-4);

  ASSERT_EQ(RunProgram("lift --labels walk.labels.json --standard-bones --out standard").code, 0);
  EXPECT_FALSE(ReadJson("standard/poses.json").contains("bodies"));
  EXPECT_GT((BvhLengths("standard/poses.bvh") - BvhLengths("own/poses.bvh")).norm(), 1e-3);
}

TEST(LiftMotion, SaysHowSureItIsAndPlotDrawsIt) {
  Labels labels = PartOfWalk(16);
  for (const size_t t : {6, 7, 8}) labels.frames[t].people.clear();
  WriteLabels(labels, ScratchDir() / "gap.labels.json");
  ASSERT_EQ(RunProgram("lift --labels gap.labels.json --out out").code, 0);
  const Json poses = ReadJson("out/poses.json");
  for (const Json& frame : poses["frames"]) {
    const Json& person = frame["people"][0];
    ASSERT_EQ(person["angles_sigma_deg"].size(), person["angles_deg"].size());
    for (const Json& sigma_deg : person["angles_sigma_deg"]) {
      EXPECT_GT(sigma_deg, 0.1);
      EXPECT_LT(sigma_deg, 90.0);
    }
  }
  const std::string angles = testing::FileText(ScratchDir() / "out/angles.csv");
  const std::string sigmas = testing::FileText(ScratchDir() / "out/angles_sigma.csv");
  EXPECT_EQ(angles.substr(0, angles.find('\n')), sigmas.substr(0, sigmas.find('\n')));
  EXPECT_EQ(std::count(sigmas.begin(), sigmas.end(), '\n'), 17);

  const std::string knee = " --angles left_knee.flexion --out knee.svg";
  ASSERT_EQ(RunProgram("plot out" + knee).code, 0);
  EXPECT_NE(testing::FileText(ScratchDir() / "knee.svg").find("standard deviation"),
            std::string::npos);
  ASSERT_EQ(RunProgram("plot out/poses.bvh" + knee).code, 0);
  EXPECT_EQ(testing::FileText(ScratchDir() / "knee.svg").find("standard deviation"),
            std::string::npos);
}

TEST(LiftMotion, FramesAloneAreNotFilled) {
  Labels labels = PartOfWalk(6);
  labels.frames[3].people.clear();
  WriteLabels(labels, ScratchDir() / "gap.labels.json");
  EXPECT_EQ(RunProgram("lift --labels gap.labels.json --frames-alone --out out").code, 0);
  EXPECT_TRUE(ReadJson("out/poses.json")["frames"][3]["people"].empty());
}

TEST(LiftMotion, TimesComeFromTheRateWhereThereAreNone) {
  Labels labels = PartOfWalk(5);
  for (FrameLabels& frame : labels.frames) frame.time_s.reset();
  WriteLabels(labels, ScratchDir() / "plain.labels.json");
  EXPECT_EQ(RunProgram("lift --labels plain.labels.json --fps 30 --out timed").code, 0);
  EXPECT_NEAR(ReadJson("timed/poses.json")["frames"][3]["time_s"].get<double>(), 0.1, 1e-9);
  EXPECT_EQ(RunProgram("lift --labels plain.labels.json --out plain").code, 0);
  EXPECT_FALSE(ReadJson("plain/poses.json")["frames"][3].contains("time_s"));
}

TEST(LiftMotion, RefusesAMotionModelThatIsNone) {
  WriteLabels(PartOfWalk(5), ScratchDir() / "walk.labels.json");
  testing::WriteScratch("not.plmotion", "something else");
  const auto run =
      RunProgram("lift --labels walk.labels.json --motion-model not.plmotion --out out");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("not.plmotion"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace poselift
