// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// `tags find` on a picture of samples/tags, against the truth of its corners, in both axes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "src/io/body_tags_toml.h"
#include "src/io/camera_yaml.h"
#include "src/io/video.h"
#include "src/tag_detection.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::ProgramRun;
using testing::RunProgram;
using testing::ScratchDir;
using testing::SourcePath;

fs::path Sample(const char* name) { return SourcePath("samples/tags") / name; }

std::string PictureOfClip() {
  const fs::path path = ScratchDir() / "tags.png";
  cv::imwrite(path.string(), VideoFile(Sample("clip.mp4").string()).Next()->bgr);
  return path.string();
}

nlohmann::json Find(const std::string& axes) {
  const fs::path lines = ScratchDir() / "tags.jsonl";
  const ProgramRun run = RunProgram(
      fmt::format("tags find {} --camera {} --tags {} --axes {} --jsonl {} --pictures {}",
                  PictureOfClip(), Sample("camera.yaml").string(), Sample("tags.toml").string(),
                  axes, lines.string(), (ScratchDir() / "seen").string()));
  EXPECT_EQ(run.code, 0) << run.err;
  return nlohmann::json::parse(std::ifstream(lines));
}

Eigen::Isometry3d PoseOf(const nlohmann::json& pose) {
  const auto q = pose.at("rotation").get<std::vector<double>>();
  const auto x_m = pose.at("position_m").get<std::vector<double>>();
  Eigen::Isometry3d cam_from_tag(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  cam_from_tag.translation() << x_m[0], x_m[1], x_m[2];
  return cam_from_tag;
}

TEST(TagsFind, CornersAreThoseOfTheTruthAndPosesSeeThemThere) {
  const nlohmann::json truth =
      nlohmann::json::parse(std::ifstream(Sample("truth.json"))).at("frames").at(0).at("tags");
  const Camera camera = ReadCameraYaml(Sample("camera.yaml"));
  const BodyTags worn = ReadBodyTags(Sample("tags.toml"));
  const nlohmann::json line = Find("poselift");
  EXPECT_EQ(line.at("axes"), "poselift");
  ASSERT_GT(line.at("tags").size(), 5U);
  for (const nlohmann::json& tag : line.at("tags")) {
    const int id = tag.at("id");
    ASSERT_TRUE(truth.contains(std::to_string(id))) << id;
    const Eigen::Isometry3d cam_from_tag = PoseOf(tag.at("poses").at(0));
    const auto corners_m = TagCorners_m(worn.Find(id)->size_m);
    for (int k = 0; k < 4; ++k) {
      const auto true_px = truth.at(std::to_string(id)).at(k).get<std::vector<double>>();
      const auto found_px = tag.at("corners_px").at(k).get<std::vector<double>>();
      const Eigen::Vector2d found(found_px[0], found_px[1]);
      EXPECT_LT((found - Eigen::Vector2d(true_px[0], true_px[1])).norm(), 1.5) << id;
      EXPECT_LT((camera.Project(cam_from_tag * corners_m.col(k)) - found).norm(), 1.5) << id;
    }
  }
  const cv::Mat seen = cv::imread((ScratchDir() / "seen" / "000000.jpg").string());
  EXPECT_EQ(seen.size(), cv::Size(1280, 720));
}

TEST(TagsFind, AxesOfApriltagRosAreTurnedByHalfATurnAboutX) {
  std::map<int, Eigen::Isometry3d> ours;
  const nlohmann::json in_ours = Find("poselift");
  for (const nlohmann::json& tag : in_ours.at("tags"))
    ours[tag.at("id")] = PoseOf(tag.at("poses").at(0));
  const nlohmann::json line = Find("apriltag_ros");
  ASSERT_EQ(line.at("tags").size(), ours.size());
  for (const nlohmann::json& tag : line.at("tags")) {
    const Eigen::Isometry3d theirs = PoseOf(tag.at("poses").at(0));
    const Eigen::Isometry3d& own = ours.at(tag.at("id"));
    EXPECT_LT((theirs.translation() - own.translation()).norm(), 1e-9);
    const Eigen::Vector3d flip(1.0, -1.0, -1.0);
    EXPECT_LT((theirs.linear() - own.linear() * flip.asDiagonal()).norm(), 1e-9);
  }
}

TEST(TagsFind, SaysWhatItDidNotFind) {
  const fs::path empty = ScratchDir() / "empty.png";
  cv::imwrite(empty.string(), cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 90, 90)));
  const ProgramRun none = RunProgram("tags find " + empty.string());
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, ::testing::HasSubstr("found no tag, wanted some of tag36h11"));
  const ProgramRun axes = RunProgram("tags find " + empty.string() + " --axes apriltag_ros");
  EXPECT_EQ(axes.code, 2);
  EXPECT_THAT(axes.err, ::testing::HasSubstr("--camera"));
  EXPECT_EQ(RunProgram("tags find nothing.png").code, 3);
}

}  // namespace
}  // namespace poselift
