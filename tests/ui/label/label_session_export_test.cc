// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: a part of the labels of a walk, the dictionary and the motion codebook that ship. Checked:
// an export goes on while the labels are worked on, is of the labels as they were when it was asked
// for, and leaves nothing when it is stopped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift/dictionary_file.h"
#include "src/input_error.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"
#include "tests/support/walk_labels.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class LabelSessionExportTest : public ::testing::Test {
 protected:
  LabelSessionExportTest()
      : dictionary_(ReadDictionary(testing::SourcePath("data/default.pldict"))),
        folder_(testing::ScratchDir() / "out") {
    fs::remove_all(folder_);
  }

  void Open(const Labels& labels) {
    session_.reset();
    project_.emplace(testing::FreshLabelsFile(testing::ScratchDir(), labels));
    session_.emplace(&*project_, lifter_, nullptr);
  }
  std::optional<fs::path> ExportTo(const fs::path& folder) {
    session_->Export(folder);
    session_->WaitUntilExported();
    return session_->TakeExported();
  }

  Dictionary dictionary_;
  PhotoLifter lifter_{dictionary_};
  std::optional<LabelProject> project_;
  std::optional<LabelSession> session_;
  fs::path folder_;
};

TEST_F(LabelSessionExportTest, IsOfTheLabelsAsTheyWereWhenItWasAskedFor) {
  Open(testing::ShortWalk(8, -1));
  EXPECT_EQ(ExportTo(folder_ / "before"), folder_ / "before");
  session_->Export(folder_ / "meanwhile");
  session_->GoToLandmark(2);
  ASSERT_TRUE(session_->Do(Action::kStepLeft));
  session_->WaitUntilExported();
  EXPECT_EQ(session_->TakeExported(), folder_ / "meanwhile");
  ExportTo(folder_ / "after");
  const auto poses = [&](const char* name) {
    return testing::FileText(folder_ / name / "poses.json");
  };
  EXPECT_EQ(poses("meanwhile"), poses("before"));
  EXPECT_NE(poses("after"), poses("before"));
}

TEST_F(LabelSessionExportTest, IsSaidWhileItGoesOnAndLeavesNothingWhenItIsStopped) {
  Labels untimed = testing::ShortWalk(60, -1);
  for (FrameLabels& frame : untimed.frames) frame.time_s.reset();
  for (const Labels& labels : {testing::ShortWalk(60, -1), untimed}) {
    Open(labels);
    session_->Export(folder_);
    EXPECT_THAT(session_->Status(), HasSubstr("exporting"));
    EXPECT_THROW(session_->Export(folder_), InputError);  // one at a time
    session_->Do(Action::kStop);
    EXPECT_THAT(session_->Status(), HasSubstr("stopped"));
    session_->WaitUntilExported();
    EXPECT_FALSE(session_->TakeExported());
    EXPECT_TRUE(!fs::exists(folder_) || fs::is_empty(folder_));  // it may not have begun
  }
}

TEST_F(LabelSessionExportTest, EndsWithTheSession) {
  Open(testing::ShortWalk(60, -1));
  session_->Export(folder_);
  session_.reset();
  EXPECT_FALSE(fs::exists(folder_ / "poses.bvh"));
}

TEST_F(LabelSessionExportTest, SaysWhatCannotBeWritten) {
  Open(testing::ShortWalk(4, -1));
  EXPECT_THROW(ExportTo("/dev/null/none"), InputError);
  EXPECT_EQ(ExportTo(folder_), folder_);
}

}  // namespace
}  // namespace poselift
