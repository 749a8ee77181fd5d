// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sample clip. Checked: it is opened as without a window, and where a person cancels that
// nothing is left.
#include "ui/window/opening.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QProgressDialog>
#include <QTimer>

#include "src/input_error.h"
#include "tests/support/support.h"
#include "ui/label/label_inputs.h"
#include "ui/label/label_project.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

std::string Clip() { return testing::SourcePath("samples/tags/clip.mp4").string(); }

fs::path FreshFile() {
  const fs::path folder = testing::ScratchDir() / "opening";
  fs::remove_all(folder);
  return folder / "clip.labels.json";
}

TEST(Opening, GivesTheLabelsFileAndTheTimesThatWereRead) {
  const fs::path file = FreshFile();
  const auto opened = OpenLabels({Clip()}, file.string(), "body15");
  ASSERT_TRUE(opened);
  const LabelProject& project = *opened->project;
  EXPECT_EQ(project.path(), file);
  ASSERT_EQ(opened->times.size(), 1U);
  EXPECT_EQ(opened->times.begin()->first, project.labels().frames[0].image);
  EXPECT_EQ(opened->times.begin()->second.size(), project.labels().frames.size());
}

TEST(Opening, OfWhatIsNoPictureThrows) {
  EXPECT_THROW(OpenLabels({testing::SourcePath("README.md").string()}, "", "body15"), InputError);
}

TEST(Opening, ToLookAtMakesNothing) {
  const fs::path file = FreshFile();
  EXPECT_THROW(OpenLabels({Clip()}, file.string(), "body15", true), InputError);
  EXPECT_FALSE(fs::exists(file));
  OpenLabels({Clip()}, file.string(), "body15");
  const auto opened = OpenLabels({Clip()}, file.string(), "body15", true);
  EXPECT_TRUE(opened->project->read_only());
}

TEST(Opening, AddsWhatIsNew) {
  const fs::path file = FreshFile();
  OpenLabels({Clip()}, file.string(), "body15");
  const std::string kick = testing::SourcePath("samples/photo/kick.jpg").string();
  const auto opened = OpenLabels({Clip(), kick}, file.string(), "body15");
  EXPECT_EQ(opened->project->labels().frames.size(), 91U);
  EXPECT_EQ(opened->project->history().UndoName(), "add pictures");
}

// It may have been done before.
TEST(Opening, LeavesNothingWhereItIsCancelled) {
  const fs::path file = FreshFile();
  QTimer::singleShot(0, [] {
    for (QWidget* window : QApplication::topLevelWidgets())
      if (auto* const opening = qobject_cast<QProgressDialog*>(window)) opening->cancel();
  });
  const auto opened = OpenLabels({Clip()}, file.string(), "body15");
  EXPECT_EQ(opened.has_value(), fs::exists(file));
}

}  // namespace
}  // namespace poselift
