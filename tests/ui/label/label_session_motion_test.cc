// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: a part of the labels of a walk, the dictionary and the motion codebook that ship. Checked:
// where the motion is shown instead of the frame by itself, that it is told when it is out of date,
// and that what is exported is what `lift` makes.
#include <gtest/gtest.h>

#include "lift/dictionary_file.h"
#include "lift/lifted_files.h"
#include "src/input_error.h"
#include "tests/support/mutation.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"
#include "tests/support/walk_labels.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

class LabelSessionMotionTest : public ::testing::Test {
 protected:
  static constexpr int kFrames = 12, kGap = 5;

  LabelSessionMotionTest()
      : dictionary_(ReadDictionary(testing::SourcePath("data/default.pldict"))),
        project_(
            testing::FreshLabelsFile(testing::ScratchDir(), testing::ShortWalk(kFrames, kGap))),
        session_(&project_, lifter_, nullptr) {}

  void Smooth() {
    EXPECT_TRUE(session_.Do(Action::kSmoothMotion));
    session_.WaitUntilSmoothed();
    ASSERT_NE(session_.motion(), nullptr);
    ASSERT_TRUE(session_.motion()->HasPoses()) << session_.motion()->message;
  }

  Dictionary dictionary_;
  PhotoLifter lifter_{dictionary_};
  LabelProject project_;
  LabelSession session_;
};

TEST_F(LabelSessionMotionTest, IsShownInAllFramesAlsoWhereNobodyHasLabels) {
  session_.WaitUntilSolved();
  EXPECT_FALSE(session_.ShowsMotion());
  EXPECT_EQ(session_.ShownPose(), session_.pose());
  Smooth();
  for (size_t f = 0; f < kFrames; ++f) {
    session_.GoToFrame(f);
    EXPECT_TRUE(session_.ShowsMotion()) << f;
    EXPECT_EQ(session_.ShownPose(), session_.motion()->PoseOf(f)) << f;
    const bool is_filled = f >= kGap && f < kGap + 3;
    EXPECT_EQ(session_.Residual_px("left_knee").has_value(), !is_filled) << f;
    EXPECT_NE(session_.Status().find(is_filled ? "filled" : "motion"), std::string::npos);
  }
  session_.GoToFrame(0);
  session_.WaitUntilSolved();
  session_.Do(Action::kNextPose);  // the frame by itself, before its other poses
  EXPECT_FALSE(session_.ShowsMotion());
  EXPECT_EQ(session_.pose_index(), 0U);
  session_.Do(Action::kShowMotion);
  EXPECT_TRUE(session_.ShowsMotion());
  session_.Do(Action::kShowMotion);
  session_.WaitUntilSolved();
  EXPECT_FALSE(session_.ShowsMotion());
  EXPECT_EQ(session_.ShownPose(), session_.pose());
}

TEST_F(LabelSessionMotionTest, IsOutOfDateWhileItsLabelsAreOthers) {
  Smooth();
  EXPECT_TRUE(session_.IsMotionCurrent());
  session_.GoToLandmark(2);
  ASSERT_TRUE(session_.Do(Action::kNudgeLeft));
  EXPECT_FALSE(session_.IsMotionCurrent());
  // What answers the labels here is what they are worked on with.
  EXPECT_FALSE(session_.ShowsMotion());
  EXPECT_THROW(session_.ExportMotion(testing::ScratchDir() / "walk.bvh"), InputError);
  session_.GoToFrame(1);
  EXPECT_TRUE(session_.ShowsMotion());
  EXPECT_NE(session_.Status().find("out of date"), std::string::npos);
  session_.Do(Action::kUndo);
  EXPECT_TRUE(session_.IsMotionCurrent());
  session_.Press({20, 20}, 5.0);  // another person's labels
  session_.Release();
  session_.Do(Action::kNewPerson);
  session_.Press({30, 20}, 5.0);
  session_.Release();
  session_.Do(Action::kUndo);
  session_.Do(Action::kUndo);
  EXPECT_TRUE(session_.IsMotionCurrent());
}

TEST_F(LabelSessionMotionTest, IsOfOnePersonAndNotOfAnother) {
  Smooth();
  session_.Do(Action::kNewPerson);
  session_.Press({30, 20}, 5.0);
  session_.Release();
  EXPECT_EQ(session_.person_index(), 1U);
  EXPECT_TRUE(session_.IsMotionCurrent());
  EXPECT_FALSE(session_.ShowsMotion());
  session_.GoToPerson(0);
  EXPECT_TRUE(session_.ShowsMotion());
}

TEST_F(LabelSessionMotionTest, FramesThatArePlayedAreNotLiftedAgain) {
  Smooth();
  session_.GoToFrame(0);
  session_.PlayTo(3);
  EXPECT_EQ(session_.frame_index(), 3U);
  EXPECT_FALSE(session_.is_solving());
  EXPECT_EQ(session_.ShownPose(), session_.motion()->PoseOf(3));
  EXPECT_TRUE(session_.Residual_px("left_knee").has_value());
  session_.WaitUntilSolved();
  EXPECT_EQ(session_.pose(), nullptr);  // an answer of the frame before is none of this
  session_.GoToFrame(3);
  session_.WaitUntilSolved();
  EXPECT_NE(session_.pose(), nullptr);
}

TEST_F(LabelSessionMotionTest, WhatIsExportedIsWhatLiftMakesOfTheLabels) {
  const fs::path folder = testing::ScratchDir();
  EXPECT_THROW(session_.ExportMotion(folder / "walk.bvh"), InputError);
  Smooth();
  const auto take = [&] {
    session_.WaitUntilExported();
    return session_.TakeExported();
  };
  for (const LiftedFormat& format : LiftedFormats()) {
    const fs::path file = folder / ("walk" + std::string(format.ending));
    session_.ExportMotion(file);
    EXPECT_EQ(take(), file);
  }
  session_.ExportMotion(folder / "walk.txt");
  EXPECT_THROW(take(), InputError);
  session_.Export(folder / "window");
  EXPECT_EQ(take(), folder / "window");
  EXPECT_FALSE(session_.TakeExported());  // once
  const auto run = testing::RunProgram("lift --labels " + project_.path().string() + " --out " +
                                       (folder / "program").string());
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* name : {"poses.bvh", "angles.csv", "angles_sigma.csv", "poses.json"})
    EXPECT_EQ(testing::FileText(folder / "window" / name),
              testing::FileText(folder / "program" / name))
        << name;
  EXPECT_EQ(testing::FileText(folder / "walk.bvh"),
            testing::FileText(folder / "program/poses.bvh"));
  EXPECT_EQ(testing::FileText(folder / "walk.csv"),
            testing::FileText(folder / "program/angles.csv"));
}

TEST_F(LabelSessionMotionTest, OneThatCannotBeMadeSaysWhy) {
  const fs::path folder = testing::ScratchDir() / "two";
  fs::create_directories(folder);
  LabelProject project(testing::FreshLabelsFile(folder, testing::ShortWalk(2, -1)));
  LabelSession session(&project, lifter_, nullptr);
  session.Do(Action::kSmoothMotion);
  session.WaitUntilSmoothed();
  ASSERT_NE(session.motion(), nullptr);
  EXPECT_NE(session.motion()->message, "");
  EXPECT_FALSE(session.ShowsMotion());
  EXPECT_THROW(session.ExportMotion(testing::ScratchDir() / "two.bvh"), InputError);
}

}  // namespace
}  // namespace poselift
