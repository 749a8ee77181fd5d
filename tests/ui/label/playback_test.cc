// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: frames with even and uneven times, and without. Checked: which is to be seen when.
#include "ui/label/playback.h"

#include <gtest/gtest.h>

namespace poselift {
namespace {

Labels FramesAt(const std::vector<std::optional<double>>& times_s) {
  Labels labels;
  for (const auto& time_s : times_s) labels.frames.push_back({.time_s = time_s});
  return labels;
}

TEST(Playback, ShowsEachFrameFromItsTimeOn) {
  const Playback play(FramesAt({5.0, 5.1, 5.5, 5.6}), 1);
  EXPECT_EQ(play.FrameAt(0.0), 1U);
  EXPECT_EQ(play.FrameAt(0.39), 1U);
  EXPECT_EQ(play.FrameAt(0.41), 2U);
  EXPECT_FALSE(play.IsOver(0.49));
  EXPECT_EQ(play.FrameAt(0.51), 3U);
  EXPECT_TRUE(play.IsOver(0.51));
  EXPECT_EQ(play.FrameAt(100.0), 3U);
}

TEST(Playback, LeavesOutWhatNobodyAskedForInTime) {
  EXPECT_EQ(Playback(FramesAt({0.0, 0.1, 0.2, 0.3, 0.4}), 0).FrameAt(0.35), 3U);
}

TEST(Playback, FramesWithoutTimesFollowAtThirtyASecond) {
  const Playback play(FramesAt({std::nullopt, std::nullopt, 9.0, 3.0}), 0);
  EXPECT_EQ(play.FrameAt(0.9 / 30.0), 0U);
  EXPECT_EQ(play.FrameAt(1.1 / 30.0), 1U);
  EXPECT_EQ(play.FrameAt(2.1 / 30.0), 2U);
  EXPECT_TRUE(play.IsOver(3.1 / 30.0));
}

TEST(Playback, OfTheLastFrameIsOverAtOnce) {
  const Playback play(FramesAt({0.0, 0.1}), 1);
  EXPECT_EQ(play.FrameAt(0.0), 1U);
  EXPECT_TRUE(play.IsOver(0.0));
}

}  // namespace
}  // namespace poselift
