// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sample clip, whose frames are read in any order, and a sample picture. Checked against
// the clip read from its beginning to its end.
#include "ui/label/frame_pictures.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "src/input_error.h"
#include "src/io/image.h"
#include "tests/support/support.h"
#include "ui/label/label_inputs.h"
#include "ui/label/label_project.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::SourcePath;

FrameLabels FrameOfClip(int index) { return {.image = "clip.mp4", .frame = index}; }

bool AreSame(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(FramePictures, GivesFramesOfAVideoInAnyOrder) {
  std::vector<cv::Mat> all;
  VideoFile clip(SourcePath("samples/tags/clip.mp4"));
  while (const auto frame = clip.Next()) all.push_back(frame->bgr);
  FramePictures pictures(SourcePath("samples/tags"));
  for (const int index : {3, 4, 20, 19, 3, 89, 0})
    EXPECT_TRUE(AreSame(pictures.Read(FrameOfClip(index)), all.at(static_cast<size_t>(index))))
        << index;
  EXPECT_THROW(pictures.Read(FrameOfClip(static_cast<int>(all.size()))), InputError);
  EXPECT_TRUE(AreSame(pictures.Read(FrameOfClip(5)), all[5]));
}

TEST(FramePictures, ReadsPicturesAndKnowsFramesWithoutOne) {
  FramePictures pictures(SourcePath("samples/photo"));
  EXPECT_TRUE(AreSame(pictures.Read({.image = "kick.jpg"}),
                      ReadImage(SourcePath("samples/photo/kick.jpg"))));
  EXPECT_TRUE(pictures.Read({}).empty());
  EXPECT_THROW(pictures.Read({.image = "none.jpg"}), InputError);
}

TEST(LabelInputs, AVideoBecomesAFrameForEachOfItsFrames) {
  const fs::path file = testing::ScratchDir() / "new" / "clip.labels.json";
  fs::remove_all(file.parent_path());
  const std::string clip = SourcePath("samples/tags/clip.mp4").string();
  EXPECT_EQ(FindLabelsFile({clip}, file.string(), "body15"), file);
  LabelProject project(file);
  const auto& frames = project.labels().frames;
  ASSERT_EQ(frames.size(), 90U);
  EXPECT_EQ(frames[7].frame, 7);
  EXPECT_NEAR(*frames[7].time_s, 7 / 30.0, 1e-3);
  EXPECT_EQ(fs::weakly_canonical(project.dir() / frames[7].image), fs::weakly_canonical(clip));
  FramePictures pictures(project.dir());
  EXPECT_EQ(pictures.Read(frames[7]).cols, frames[7].width_px);
}

}  // namespace
}  // namespace poselift
