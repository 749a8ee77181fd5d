// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: key frames that are told apart by a pin. Checked: where key frames come to be and go,
// that times stay those of the poses they belong to, and that all of it can be taken back and is in
// the journal's lines.
#include "ui/label/key_edits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "src/io/labels.h"
#include "src/joints.h"
#include "ui/label/journal_line.h"

namespace poselift {
namespace {

// A pose that a height tells from others.
std::vector<PersonLabels> Posed(double height_dm) {
  PersonLabels person;
  for (const char* joint : {"left_wrist", "right_wrist", "left_ankle", "right_ankle"})
    person.hints.push_back({.kind = LabelHint::Kind::kPin,
                            .joint = joint,
                            .metres_m = 0.05,
                            .x_in_cam_m = {0.1, height_dm / 10.0, 0.0}});
  return {person};
}

class KeyEditsTest : public ::testing::Test {
 protected:
  KeyEditsTest() {
    Labels labels{"body15", {}};
    for (const int number : {0, 10, 20, 40}) {
      FrameLabels frame{.time_s = number / 25.0, .frame = number};
      frame.people = Posed(number);
      labels.frames.push_back(frame);
    }
    history_ = LabelHistory(labels);
  }

  KeyTimes Keys() const { return KeyTimesOf(history_.labels()); }
  // By which pose is when: its height, its number, its time.
  std::vector<std::pair<double, int>> Poses() const {
    std::vector<std::pair<double, int>> poses;
    for (const FrameLabels& frame : history_.labels().frames) {
      EXPECT_DOUBLE_EQ(*frame.time_s, *frame.frame / Keys().fps);
      poses.emplace_back(std::round(100.0 * frame.people[0].hints[0].x_in_cam_m.y()) / 10.0,
                         *frame.frame);
    }
    return poses;
  }
  // Done, undone, done again, and the same by way of the journal.
  void Apply(const LabelEdit& edit) {
    const std::string before = LabelsText(history_.labels());
    ASSERT_TRUE(history_.Apply(edit)) << edit.name;
    const std::string after = LabelsText(history_.labels());
    const LabelStep& step = *history_.steps().back();
    const JournalLine line =
        ReadJournalLine(EditLine(step.edit, step.before), "journal", 1, *FindLayout("body15"));
    EXPECT_EQ(line.edit.times, step.edit.times);
    EXPECT_EQ(line.before.times, step.before.times);
    history_.Undo();
    EXPECT_EQ(LabelsText(history_.labels()), before) << edit.name;
    history_.Redo();
    EXPECT_EQ(LabelsText(history_.labels()), after) << edit.name;
    history_.Seal();
  }
  using PosesAt = std::vector<std::pair<double, int>>;

  LabelHistory history_{Labels{}};
};

TEST_F(KeyEditsTest, OneIsAddedWhereverItIsWanted) {
  Apply(AddKeyFrame(history_.labels(), Keys(), 15, Posed(1.5)));
  EXPECT_EQ(history_.UndoName(), "add key frame 3");
  EXPECT_EQ(Poses(), (PosesAt{{0, 0}, {10, 10}, {1.5, 15}, {20, 20}, {40, 40}}));
  Apply(AddKeyFrame(history_.labels(), Keys(), 60, Posed(6.0)));
  EXPECT_EQ(Poses().back(), std::pair(6.0, 60));
}

TEST_F(KeyEditsTest, WithoutRoomThoseBehindGoOn) {
  Apply(MoveKeyFrame(history_.labels(), Keys(), 1, 19, Along::kAlone));
  Apply(AddKeyFrame(history_.labels(), Keys(), NumberBehind(Keys(), 1), Posed(1.5)));
  EXPECT_EQ(Poses(), (PosesAt{{0, 0}, {10, 19}, {1.5, 20}, {20, 21}, {40, 40}}));
}

TEST_F(KeyEditsTest, TheNextOneIsHalfWayOrAGapBehind) {
  EXPECT_EQ(NumberBehind(Keys(), 0), 5);
  EXPECT_EQ(NumberBehind(Keys(), 2), 30);
  EXPECT_EQ(NumberBehind(Keys(), 3), 40 + Keys().Gap());
  EXPECT_EQ(Keys().Gap(), 13);  // half a second of 25
}

TEST_F(KeyEditsTest, TheTimesOfTheOthersStayWhenOneGoes) {
  Apply(RemoveKeyFrame(history_.labels(), Keys(), 1));
  EXPECT_EQ(Poses(), (PosesAt{{0, 0}, {20, 20}, {40, 40}}));
  Apply(RemoveKeyFrame(history_.labels(), Keys(), 0));
  Apply(RemoveKeyFrame(history_.labels(), Keys(), 1));
  EXPECT_EQ(Poses(), (PosesAt{{20, 20}}));
  EXPECT_THROW(RemoveKeyFrame(history_.labels(), Keys(), 0), std::invalid_argument);
}

TEST_F(KeyEditsTest, OneMovesUpToItsNeighboursOrTakesAllBehindAlong) {
  const auto move = [&](size_t key, int number, Along along) {
    Apply(MoveKeyFrame(history_.labels(), Keys(), key, number, along));
  };
  move(1, 35, Along::kAlone);
  EXPECT_EQ(Poses()[1].second, 19);
  move(1, 4, Along::kAllBehind);
  EXPECT_EQ(Poses(), (PosesAt{{0, 0}, {10, 4}, {20, 5}, {40, 25}}));
  move(1, -3, Along::kAllBehind);
  EXPECT_EQ(Poses()[1].second, 1);
  move(3, 99, Along::kAlone);
  EXPECT_EQ(Poses()[3].second, 99);
  move(0, 1 << 30, Along::kAllBehind);
  EXPECT_EQ(Poses()[3].second, KeyTimes::kMostNumber);
  EXPECT_TRUE(MoveKeyFrame(history_.labels(), Keys(), 3, 1 << 30, Along::kAlone).ChangesNothing());
}

TEST_F(KeyEditsTest, MovesInARowAreOneStep) {
  for (const int number : {11, 12, 13})
    history_.Apply(MoveKeyFrame(history_.labels(), Keys(), 1, number, Along::kAlone));
  EXPECT_EQ(history_.NumSteps(), 1U);
  history_.Undo();
  EXPECT_EQ(Poses()[1].second, 10);
}

TEST_F(KeyEditsTest, AnotherRateKeepsTheTimesAsFarAsItCan) {
  Apply(ChangeKeyRate(history_.labels(), Keys(), 50.0));
  EXPECT_EQ(Poses(), (PosesAt{{0, 0}, {10, 20}, {20, 40}, {40, 80}}));
  Apply(ChangeKeyRate(history_.labels(), Keys(), 2.0));
  EXPECT_EQ(Poses(), (PosesAt{{0, 0}, {10, 1}, {20, 2}, {40, 3}}));
  EXPECT_EQ(Keys().fps, 2.0);
}

TEST_F(KeyEditsTest, PicturesHaveNone) {
  Labels pictures = history_.labels();
  pictures.frames[0].image = "a.jpg";
  EXPECT_THROW(AddKeyFrame(pictures, Keys(), 5, {}), std::invalid_argument);
  EXPECT_THROW(RemoveKeyFrame(pictures, Keys(), 0), std::invalid_argument);
  EXPECT_THROW(MoveKeyFrame(pictures, Keys(), 0, 1, Along::kAlone), std::invalid_argument);
  EXPECT_THROW(ChangeKeyRate(pictures, Keys(), 24.0), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
