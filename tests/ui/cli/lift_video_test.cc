// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// `poselift lift` of a video, run as a user would: made-up texture that stands
// still, labels at three of its twelve frames, a made-up dictionary. Whether the
// poses are right is tested elsewhere; here it is which frames come out, their
// times, the pictures, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "lift/dictionary_file.h"
#include "src/io/image.h"
#include "src/io/poses_json.h"
#include "src/io/video.h"
#include "tests/support/broken_input.h"
#include "tests/support/made_up_video.h"
#include "tests/support/mutation.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::ExpectRefusal;
using testing::FileText;
using ::testing::HasSubstr;
using testing::ProgramRun;
using testing::Replaced;
using testing::RunProgram;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

constexpr int kNumFrames = 12;
constexpr double kRate_hz = 20.0;

std::string FrameAt(const std::string& place) {
  return R"({"image": "man.mp4", "width": 480, "height": 480, )" + place +
         R"(, "people": [{"id": 0, "joints": {
 "left_hip": {"x": 230, "y": 250}, "left_knee": {"x": 235, "y": 330},
 "left_ankle": {"x": 237, "y": 410}, "right_hip": {"x": 200, "y": 250},
 "right_knee": {"x": 195, "y": 330}, "right_ankle": {"x": 193, "y": 410},
 "left_shoulder": {"x": 250, "y": 140}, "left_elbow": {"x": 275, "y": 190},
 "left_wrist": {"x": 280, "y": 245}, "right_shoulder": {"x": 180, "y": 140},
 "right_elbow": {"x": 155, "y": 190}, "right_wrist": {"x": 150, "y": 245}}}]})";
}

std::string LabelsAt(const std::string& a, const std::string& b, const std::string& c) {
  return R"({"format": "poselift-labels", "version": 1, "frames": [)" + FrameAt(a) + ",\n" +
         FrameAt(b) + ",\n" + FrameAt(c) + "]}\n";
}

const std::string kByFrame = LabelsAt("\"frame\": 2", "\"frame\": 8", "\"frame\": 5");
const std::string kLift = "lift man.mp4 --labels labels.json --dictionary d.pldict --out out ";

// man.mp4, labels.json and d.pldict.
void WriteInputs() {
  auto rng = TestRng();
  Dictionary dictionary = testing::RandomDictionary(20, &rng);
  dictionary.prior = LearnPosePrior(testing::RandomDictionary(200, &rng).atoms);
  WriteDictionary(dictionary, ScratchDir() / "d.pldict");
  WriteScratch("labels.json", kByFrame);
  testing::WriteVideo(ScratchDir() / "man.mp4",
                      std::vector<cv::Mat>(kNumFrames, testing::Texture({480, 480}, &rng)),
                      kRate_hz);
}

std::vector<double> TimesOf(const fs::path& poses) {
  std::vector<double> times_s;
  for (const FramePoses& frame : ReadPosesJson(poses).frames) times_s.push_back(*frame.time_s);
  return times_s;
}

TEST(LiftVideo, LiftsTheFramesBetweenTheLabelledOnesToo) {
  WriteInputs();
  const ProgramRun run = RunProgram(kLift + "--max-gap-s 0.16 --overlay-video");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  // 3 frames around the first and behind the last labels, at 0.05 s each.
  const auto times_s = TimesOf(ScratchDir() / "out/poses.json");
  ASSERT_EQ(times_s.size(), 12u);
  for (size_t i = 0; i < times_s.size(); ++i)
    EXPECT_NEAR(times_s[i], static_cast<double>(i) / kRate_hz, 1e-4);
  EXPECT_GT(ReadImage(ScratchDir() / "out/man.strip.png").cols, 2000);
  EXPECT_EQ(ReadFrameTimes(ScratchDir() / "out/man.overlay.avi").size(), 12u);
  EXPECT_FALSE(fs::exists(ScratchDir() / "out/man.unfinished.avi"));
}

TEST(LiftVideo, LiftsTheLabelledFramesAloneWithoutPropagation) {
  WriteInputs();
  const ProgramRun run = RunProgram(kLift + "--no-propagate");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(TimesOf(ScratchDir() / "out/poses.json"),
              ::testing::Pointwise(::testing::DoubleNear(1e-4), {0.1, 0.25, 0.4}));
  EXPECT_FALSE(fs::exists(ScratchDir() / "out/man.overlay.avi"));
}

TEST(LiftVideo, FindsTheVideoThatTheLabelsName) {
  WriteInputs();
  const ProgramRun run =
      RunProgram("lift --labels labels.json --dictionary d.pldict --out out --no-propagate");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(TimesOf(ScratchDir() / "out/poses.json").size(), 3u);
  EXPECT_TRUE(fs::exists(ScratchDir() / "out/man.strip.png"));
}

TEST(LiftVideo, FindsTheLabelsBesideTheVideo) {
  WriteInputs();
  fs::rename(ScratchDir() / "labels.json", ScratchDir() / "man.labels.json");
  const ProgramRun run = RunProgram("lift man.mp4 --dictionary d.pldict --out out --no-propagate");
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST(LiftVideo, TakesLabelsByTheirTime) {
  WriteInputs();
  WriteScratch("labels.json", LabelsAt("\"time_s\": 0.11", "\"time_s\": 0.38", "\"frame\": 5"));
  const ProgramRun run = RunProgram(kLift + "--no-propagate");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(TimesOf(ScratchDir() / "out/poses.json"),
              ::testing::Pointwise(::testing::DoubleNear(1e-4), {0.1, 0.25, 0.4}));
}

TEST(LiftVideo, RefusesLabelsThatDoNotFit) {
  WriteInputs();
  const auto refuse = [](const std::string& labels, const std::string& mention) {
    WriteScratch("labels.json", labels);
    ExpectRefusal(kLift, mention);
  };
  refuse(LabelsAt("\"frame\": 2", "\"frame\": 12", "\"frame\": 5"), "frame 12");
  refuse(LabelsAt("\"frame\": 2", "\"frame\": 2", "\"frame\": 5"), "frame 2 twice");
  refuse(LabelsAt("\"time_s\": 9", "\"frame\": 2", "\"frame\": 5"), "9 s");
  refuse(LabelsAt("\"id\": 1", "\"frame\": 2", "\"frame\": 5"), "time_s");
  refuse(LabelsAt("\"frame\": -1", "\"frame\": 2", "\"frame\": 5"), "frames[0].frame");
  refuse(Replaced(kByFrame, "480", "640"), "640 x 480");
  std::string others = kByFrame;
  for (size_t at; (at = others.find("man.mp4")) != std::string::npos;) others.replace(at, 3, "cat");
  refuse(others, "man.mp4");
}

TEST(LiftVideo, RefusesBrokenVideosBeforeItWritesAnything) {
  WriteInputs();
  const std::string whole = FileText(ScratchDir() / "man.mp4");
  testing::ExpectRefusals("man.mp4", whole,
                          {"lift {} --labels labels.json --dictionary d.pldict "
                           "--out out"},
                          {{"truncated", whole.substr(0, whole.size() / 2), ": is cut short"},
                           {"text", "no video\n", ": is no video"}});
  WriteInputs();
  ExpectRefusal("lift man.mp4 man.mp4 --labels labels.json --dictionary d.pldict --out out",
                "is a video");
}

}  // namespace
}  // namespace poselift
