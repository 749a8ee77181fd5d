// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The program itself, run on a made-up file of every kind: `info` knows the kind
// by the content, whatever the name, and its facts are the file's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "src/io/bvh.h"
#include "src/io/camera_yaml.h"
#include "src/io/image.h"
#include "src/io/poses_json.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/mutation.h"
#include "tests/support/random_codebook.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using nlohmann::json;
using testing::FileText;
using ::testing::HasSubstr;
using testing::ProgramRun;
using testing::RunProgram;
using testing::ScratchDir;
using testing::SourcePath;
using testing::TestRng;
using testing::WriteScratch;

json FactsOf(const std::string& file) {
  const ProgramRun run = RunProgram("info " + file + " --json facts.json");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  return json::parse(FileText(ScratchDir() / "facts.json"))["files"][0];
}

TEST(Info, DescribesEveryMotionFormat) {
  auto rng = TestRng();
  const AsfSkeleton asf = ReadAsfSkeleton(WriteScratch("09.asf", std::string(testing::kMadeUpAsf)));
  Motion motion = testing::RandomMotion(asf.skeleton, 12, &rng);
  motion.frame_time_s = kCmuFrameTime_s;
  WriteAmc(motion, asf, ScratchDir() / "09_01.amc");
  WriteBvh(motion, ScratchDir() / "a.bvh");
  std::filesystem::copy(ScratchDir() / "a.bvh", ScratchDir() / "by_content");
  EXPECT_EQ(RunProgram("info a.bvh 09_01.amc 09.asf by_content --json facts.json").code, 0);
  const auto facts = json::parse(FileText(ScratchDir() / "facts.json"));
  EXPECT_EQ(facts["command"], "info");
  ASSERT_EQ(facts["files"].size(), 4u);
  EXPECT_EQ(facts["files"][0]["kind"], "BVH motion");
  EXPECT_EQ(facts["files"][3]["kind"], "BVH motion");
  EXPECT_EQ(facts["files"][1]["frames"], 12);
  EXPECT_EQ(facts["files"][1]["bones"], motion.skeleton.bones.size());
  EXPECT_EQ(facts["files"][1]["dofs"], 6 + motion.skeleton.NumDofs());
  EXPECT_NEAR(facts["files"][0]["rate_hz"], 120.0, 1e-3);
  EXPECT_NEAR(facts["files"][0]["highest_m"][1], facts["files"][1]["highest_m"][1], 1e-6);
}

TEST(Info, GoesOnAfterAnUnreadableFile) {
  WriteScratch("09.asf", std::string(testing::kMadeUpAsf));
  WriteScratch("strange", "\xFF\xFE nothing");
  const ProgramRun run = RunProgram("info strange absent . 09.asf --json facts.json");
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.err, HasSubstr("of no kind I know"));
  EXPECT_THAT(run.err, HasSubstr("no such file"));
  const auto facts = json::parse(FileText(ScratchDir() / "facts.json"));
  ASSERT_EQ(facts["files"].size(), 4u);
  EXPECT_TRUE(facts["files"][0].contains("error"));
  EXPECT_EQ(facts["files"][3]["kind"], "ASF skeleton");
}

TEST(Info, CountsWhatLabelsSay) {
  std::filesystem::copy(SourcePath("tests/golden/labels.json"), ScratchDir() / "by_content");
  const json facts = FactsOf("by_content");
  EXPECT_EQ(facts["kind"], "labels");
  EXPECT_EQ(facts["layout"], "body15");
  EXPECT_EQ(facts["frames"], 2);
  EXPECT_EQ(facts["people"], 1);
  EXPECT_EQ(facts["visible"], 2);
  EXPECT_EQ(facts["occluded"], 1);
  EXPECT_EQ(facts["absent"], 1);
  EXPECT_EQ(facts["pictures"], 1);
  EXPECT_EQ(facts["picture_width_px"], json({640, 640}));
  EXPECT_EQ(facts["picture_height_px"], json({425, 425}));
}

TEST(Info, KnowsLabelsOfCocoAndOpenPoseAndItsFolders) {
  std::string keypoints = "9, 8, 2";
  for (int i = 1; i < 17; ++i) keypoints += ", 5, 6, 0";
  WriteScratch("coco.json", "\n[{\"image_id\": 1, \"keypoints\": [" + keypoints + "]}]");
  const json coco = FactsOf("coco.json");
  EXPECT_EQ(coco["layout"], "coco17");
  EXPECT_EQ(coco["visible"], 1);
  EXPECT_EQ(coco["absent"], 16);

  std::string values = "9, 8, 0.9";
  for (int i = 1; i < 25; ++i) values += ", 0, 0, 0";
  std::filesystem::create_directory(ScratchDir() / "frames");
  for (const char* name : {"frames/a_0_keypoints.json", "frames/a_1_keypoints.json"})
    WriteScratch(name, "{\"people\": [{\"pose_keypoints_2d\": [" + values + "]}]}");
  EXPECT_EQ(FactsOf("frames/a_0_keypoints.json")["frames"], 1);
  const json folder = FactsOf("frames");
  EXPECT_EQ(folder["layout"], "openpose25");
  EXPECT_EQ(folder["frames"], 2);
  EXPECT_EQ(folder["visible"], 2);
}

TEST(Info, SumsUpLiftedPoses) {
  Poses poses;
  for (int f = 0; f < 4; ++f) {
    poses.frames.push_back({"", 0.5 * f, {PersonPose{.id = 1, .status = "ok"}}});
    poses.frames.back().people[0].reprojection_rms_px = std::array{3.0, 1.0, 9.0, 2.0}[f];
  }
  poses.frames[1].people.push_back({.id = 2, .status = "cannot lift"});
  WritePosesJson(poses, ScratchDir() / "poses.json");
  const json facts = FactsOf("poses.json");
  EXPECT_EQ(facts["kind"], "lifted poses");
  EXPECT_EQ(facts["frames"], 4);
  EXPECT_EQ(facts["people"], 5);
  EXPECT_EQ(facts["ok"], 4);
  EXPECT_EQ(facts["statuses"], json({{"ok", 4}, {"cannot lift", 1}}));
  EXPECT_EQ(facts["median_rms_px"], 3.0);
  EXPECT_EQ(facts["largest_rms_px"], 9.0);
  EXPECT_EQ(facts["time_s"], json({0.0, 1.5}));
}

TEST(Info, KnowsAStreamOfPoses) {
  Poses poses;
  std::string lines;
  for (int f = 0; f < 3; ++f)
    lines += FramePosesLine({"", 0.5 * f, {PersonPose{.id = 1, .status = "ok"}}});
  WriteScratch("by_content", lines);
  const json facts = FactsOf("by_content");
  EXPECT_EQ(facts["kind"], "lifted poses");
  EXPECT_EQ(facts["frames"], 3);
  EXPECT_EQ(facts["time_s"], json({0.0, 1.0}));
}

TEST(Info, KnowsReportsAndTablesOfAngles) {
  WriteScratch("r.json", R"({"command": "track", "input": "walk.mkv", "ok": 7, "rows": [1, 2]})");
  const json report = FactsOf("r.json");
  EXPECT_EQ(report["kind"], "report");
  EXPECT_EQ(report["command"], "track");
  EXPECT_EQ(report["ok"], 7);
  EXPECT_EQ(report["rows"], "2 entries");
  WriteScratch("angles.csv", "frame,time_s,left_knee.flexion\r\n0,0,1.5\r\n1,0.5,\r\n");
  const json angles = FactsOf("angles.csv");
  EXPECT_EQ(angles["kind"], "table of angles");
  EXPECT_EQ(angles["angles"], 1);
  EXPECT_EQ(angles["frames"], 2);
  EXPECT_EQ(angles["known"], 1);
  WriteScratch("cut.csv", "frame,time_s,left_knee.flexion\r\n0,0\r\n");
  EXPECT_THAT(RunProgram("info cut.csv").err, HasSubstr("cut.csv:2: found 2 fields, wanted 3"));
}

TEST(Info, KnowsVideosAndFoldersOfPictures) {
  const json video = FactsOf(SourcePath("samples/tags/clip.mp4").string());
  EXPECT_EQ(video["kind"], "video");
  EXPECT_NEAR(video["rate_hz"], 30.0, 0.01);
  EXPECT_NEAR(video["duration_s"], video["frames"].get<double>() / 30.0, 0.01);
  std::filesystem::create_directory(ScratchDir() / "frames");
  for (const char* name : {"frames/b2.png", "frames/b10.png"})
    WritePng(ScratchDir() / name, cv::Mat(40, 60, CV_8UC3, cv::Scalar(1, 2, 3)));
  const json folder = FactsOf("frames");
  EXPECT_EQ(folder["kind"], "folder of pictures");
  EXPECT_EQ(folder["pictures"], 2);
  EXPECT_EQ(folder["width_px"], 60);
  EXPECT_EQ(folder["last"], "b10.png");
}

TEST(Info, KnowsTrueJointsOverTime) {
  const json facts = FactsOf(SourcePath("samples/tags/truth.json").string());
  EXPECT_EQ(facts["kind"], "true joints");
  EXPECT_GT(facts["frames"], 10);
  EXPECT_EQ(facts["time_s"][0], 0.0);
}

TEST(Info, KnowsTrueJoints) {
  WriteScratch("truth.json",
               R"({"joints_in_cam": {"left_hip": [0, 0, 1], "right_hip": [1, 0, 1],
"left_knee": [0, 1, 1], "right_knee": [1, 1, 1]}})");
  const json facts = FactsOf("truth.json");
  EXPECT_EQ(facts["kind"], "true joints");
  EXPECT_EQ(facts["joints"], 4);
}

TEST(Info, SaysHowWideACameraSees) {
  const Camera camera{.width_px = 200,
                      .height_px = 100,
                      .fx_px = 100,
                      .fy_px = 50,
                      .cx_px = 99.5,
                      .cy_px = 49.5,
                      .distortion = {}};
  WriteCameraYaml(camera, ScratchDir() / "by_content");
  const json facts = FactsOf("by_content");
  EXPECT_EQ(facts["kind"], "camera");
  EXPECT_EQ(facts["width_px"], 200);
  EXPECT_EQ(facts["focal_length_px"], json({100.0, 50.0}));
  EXPECT_NEAR(facts["view_width_deg"], 90.0, 1e-9);  // 2 atan(100 / 100)
  EXPECT_NEAR(facts["view_height_deg"], 90.0, 1e-9);
  EXPECT_EQ(facts["distortion"]["k1"], 0.0);
}

TEST(Info, ReadsTheTrainingRecordOfADictionary) {
  auto rng = TestRng();
  Dictionary dictionary = testing::RandomDictionary(5, &rng);
  dictionary.skeleton = testing::TrimmedCmuLikeSkeleton();
  dictionary.record.num_poses = 1234;
  dictionary.record.seed = 77;
  dictionary.record.command = "poselift train --seed 77";
  WriteDictionary(dictionary, ScratchDir() / "by_content");
  const json facts = FactsOf("by_content");
  EXPECT_EQ(facts["kind"], "pose dictionary");
  EXPECT_EQ(facts["atoms"], 5);
  EXPECT_EQ(facts["training_poses"], 1234);
  EXPECT_EQ(facts["seed"], 77);
  EXPECT_EQ(facts["command"], "poselift train --seed 77");
  EXPECT_EQ(facts["pose_prior"], false);
  EXPECT_NEAR(facts["height_m"], 1.65, 0.15);  // the skeleton is about 1.75 m tall
}

TEST(Info, ReadsTheTrainingRecordOfAMotionCodebook) {
  MotionCodebook codebook = testing::RandomCodebook(3);
  codebook.record.num_segments = 21;
  codebook.record.command = "poselift train --motion";
  WriteMotionCodebook(codebook, ScratchDir() / "by_content");
  const json facts = FactsOf("by_content");
  EXPECT_EQ(facts["kind"], "motion codebook");
  EXPECT_EQ(facts["segments"], 3);
  EXPECT_EQ(facts["training_segments"], 21);
  EXPECT_NEAR(facts["duration_s"], 8.0 / 15.0, 1e-12);
  EXPECT_EQ(facts["command"], "poselift train --motion");
}

TEST(Info, KnowsKalibrsTarget) {
  WriteScratch("grid.yaml",
               "target_type: 'aprilgrid'\ntagCols: 6\ntagRows: 5\ntagSize: 0.088\n"
               "tagSpacing: 0.25\n");
  const json facts = FactsOf("grid.yaml");
  EXPECT_EQ(facts["kind"], "calibration board");
  EXPECT_EQ(facts["family"], "tag36h11b2");
  EXPECT_EQ(facts["tags"], json({{"rows", 5}, {"columns", 6}}));
  EXPECT_EQ(facts["ids"], json({0, 29}));
  EXPECT_NEAR(facts["size_m"][0], 0.088 * (6 + 5 * 0.25), 1e-9);
  WriteScratch("chess.yaml", "target_type: 'checkerboard'\ntargetCols: 6\n");
  const ProgramRun chess = RunProgram("info chess.yaml");
  EXPECT_EQ(chess.code, 3);
  EXPECT_THAT(chess.err, HasSubstr("chess.yaml:1: target_type: found"));
}

TEST(Info, SaysSizeAndFormatOfAPicture) {
  WritePng(ScratchDir() / "p.png", cv::Mat(40, 60, CV_8UC3, cv::Scalar(1, 2, 3)));
  std::filesystem::rename(ScratchDir() / "p.png", ScratchDir() / "by_content");
  const json facts = FactsOf("by_content");
  EXPECT_EQ(facts["kind"], "picture");
  EXPECT_EQ(facts["format"], "PNG");
  EXPECT_EQ(facts["width_px"], 60);
  EXPECT_EQ(facts["height_px"], 40);
}

}  // namespace
}  // namespace poselift
