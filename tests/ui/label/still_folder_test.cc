// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Stills in a real folder, read back with our own readers; a folder with labels already, one that
// is open elsewhere, and undo.
#include "ui/label/still_folder.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "lift/dictionary_file.h"
#include "src/input_error.h"
#include "src/io/image.h"
#include "src/io/labels.h"
#include "tests/support/support.h"
#include "ui/label/label_inputs.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::ScratchDir;

const cv::Mat kPicture(48, 64, CV_8UC3, cv::Scalar(1, 2, 3));

std::vector<LandmarkLabel> Knee(const Layout& /*layout*/) {
  return {{.name = "left_knee", .x_px = {12.0, 30.0}, .state = LabelState::kOccluded}};
}

TEST(StillFolder, PicturesGetFreeNumbersAndTheirLabels) {
  const fs::path folder = ScratchDir() / "new" / "live";
  StillFolder stills(folder, "body15");
  EXPECT_EQ(stills.Add(kPicture, Knee), 0U);
  testing::WriteScratch("new/live/still-0002.png", "mine");
  EXPECT_EQ(stills.Add(kPicture, {}), 1U);
  stills.project()->Save();
  const Labels labels = ReadLabels(folder / "labels.json");
  ASSERT_EQ(labels.frames.size(), 2U);
  EXPECT_EQ(labels.frames[0].image, "still-0001.png");
  EXPECT_EQ(labels.frames[1].image, "still-0003.png");
  EXPECT_EQ(labels.frames[0].width_px, 64);
  ASSERT_EQ(labels.frames[0].people.size(), 1U);
  EXPECT_EQ(labels.frames[0].people[0].landmarks[0].state, LabelState::kOccluded);
  EXPECT_TRUE(labels.frames[1].people.empty());
  EXPECT_EQ(cv::norm(ReadImage(folder / "still-0003.png"), kPicture, cv::NORM_INF), 0.0);
}

TEST(StillFolder, GoesOnWithTheLabelsThatAreThere) {
  StillFolder(ScratchDir(), "joints23").Add(kPicture, {});
  StillFolder stills(ScratchDir(), "body15");
  std::string asked;
  EXPECT_EQ(stills.Add(kPicture,
                       [&](const Layout& layout) {
                         asked = layout.name;
                         return Knee(layout);
                       }),
            1U);
  EXPECT_EQ(asked, "joints23");
  // `poselift label FOLDER` works on the same file.
  EXPECT_EQ(FindLabelsFile({ScratchDir().string()}, "", "body15"), ScratchDir() / "labels.json");
}

TEST(StillFolder, IsRefusedWhereAnotherWindowWorks) {
  StillFolder first(ScratchDir(), "body15"), second(ScratchDir(), "body15");
  first.Add(kPicture, {});
  EXPECT_THROW(second.Add(kPicture, {}), InputError);
  EXPECT_FALSE(fs::exists(ScratchDir() / "still-0002.png"));
  const std::string file = testing::WriteScratch("file", "");
  EXPECT_THROW(StillFolder(file, "body15").Add(kPicture, {}), InputError);
}

TEST(StillFolder, AStillThatIsUndoneLeavesTheOneBefore) {
  const Dictionary dictionary = ReadDictionary(testing::SourcePath("data/default.pldict"));
  const PhotoLifter lifter(dictionary);
  StillFolder stills(ScratchDir(), "body15");
  stills.Add(kPicture, {});
  LabelSession session(stills.project(), lifter, {});
  session.GoToFrame(stills.Add(kPicture, Knee));
  EXPECT_EQ(session.frame_index(), 1U);
  EXPECT_TRUE(session.Do(Action::kUndo));
  EXPECT_EQ(session.frame_index(), 0U);
  EXPECT_EQ(session.Frame().image, "still-0001.png");
  EXPECT_TRUE(session.Do(Action::kRedo));
  EXPECT_EQ(session.labels().frames.size(), 2U);
}

}  // namespace
}  // namespace poselift
