// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The program itself, on videos and folders that are written here; cameras are played by a
// made-up one in source_findings_test.cc and by the kernel's in tests/v4l2_vm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/tag_family.h"
#include "tests/support/made_up_video.h"
#include "tests/support/mutation.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using nlohmann::json;
using testing::FileText;
using ::testing::HasSubstr;
using testing::RunProgram;
using testing::ScratchDir;

cv::Mat TagPicture(bool is_mirrored) {
  cv::Mat print, picture(240, 320, CV_8UC3, cv::Scalar::all(200));
  cv::resize(TagFamily("tag36h11").Image(3), print, {}, 12, 12, cv::INTER_NEAREST);
  cv::cvtColor(print, print, cv::COLOR_GRAY2BGR);
  print.copyTo(picture(cv::Rect(40, 40, print.cols, print.rows)));
  if (is_mirrored) cv::flip(picture, picture, 1);
  return picture;
}

std::vector<std::string> WhatOf(const json& report) {
  std::vector<std::string> what;
  for (const json& finding : report["findings"]) what.push_back(finding["what"]);
  return what;
}

TEST(DoctorProgram, LooksThroughAVideo) {
  const auto folder = ScratchDir();
  testing::WriteVideo(folder / "a.mp4", std::vector<cv::Mat>(30, TagPicture(true)), 15.0);
  const auto run = RunProgram("doctor a.mp4 --json out.json");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("a.mp4: 30 pictures of 320x240 in 1.93 s, 15 a second"));
  EXPECT_THAT(run.out, HasSubstr("problem  is mirrored"));
  const json report = json::parse(FileText(folder / "out.json"));
  EXPECT_EQ(report["num_pictures"], 30);
  EXPECT_NEAR(report["rate_hz"], 15.0, 0.01);
  EXPECT_EQ(report["tags"]["num_found"], 0);
  EXPECT_THAT(WhatOf(report), ::testing::Contains(HasSubstr("is mirrored")));
}

TEST(DoctorProgram, LooksThroughAFolder) {
  const auto folder = ScratchDir();
  std::filesystem::create_directory(folder / "shots");
  for (const char* name : {"1.png", "2.png", "3.png"})
    cv::imwrite(folder / "shots" / name, TagPicture(false));
  const auto run = RunProgram("doctor shots --json out.json");
  EXPECT_EQ(run.code, 0) << run.err;
  const json report = json::parse(FileText(folder / "out.json"));
  EXPECT_EQ(report["tags"]["num_found"], 3);
  EXPECT_THAT(WhatOf(report), ::testing::Not(::testing::Contains(HasSubstr("is mirrored"))));
}

TEST(DoctorProgram, ListsTheCamerasThereAre) {
  const auto run = RunProgram("doctor");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, ::testing::AnyOf(HasSubstr("There is no camera"), HasSubstr("/dev/video")));
}

TEST(DoctorProgram, SaysWhatItCannotRead) {
  for (const auto& [arguments, code, mention] :
       {std::tuple("doctor absent.mp4", 3, "absent.mp4: no such file; wanted a camera"),
        {"doctor /dev/video987", 3, "/dev/video987: no such device; plug the camera in"},
        {"doctor /dev/null", 3, "/dev/null: is no video device"},
        {"doctor --size 12", 2, "wanted WIDTHxHEIGHT"},
        {"doctor --format H264", 2, "wanted MJPG, YUYV, NV12 or GREY"},
        {"doctor --set gain", 2, "wanted name=value"}}) {
    const auto run = RunProgram(arguments);
    EXPECT_EQ(run.code, code) << arguments;
    EXPECT_THAT(run.err, HasSubstr(mention)) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
  }
}

}  // namespace
}  // namespace poselift
