// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: two people in one picture. Checked: which landmark a click means.
#include "ui/label/picture_hit.h"

#include <gtest/gtest.h>

namespace poselift {
namespace {

FrameLabels TwoPeople() {
  FrameLabels frame;
  frame.people = {{0, {{"left_knee", {100, 100}}, {"right_knee", {120, 100}}}},
                  {1, {{"left_knee", {-5, 40}}, {"right_knee", {120, 100}}}}};
  return frame;
}

TEST(PictureHit, IsTheNearestWithinReach) {
  const FrameLabels frame = TwoPeople();
  EXPECT_EQ(HitLandmark(frame, {103, 100}, 10), (PictureHit{0, 0}));
  EXPECT_EQ(HitLandmark(frame, {111, 100}, 20), (PictureHit{0, 1}));
  EXPECT_FALSE(HitLandmark(frame, {100, 130}, 10));
  EXPECT_EQ(HitLandmark(frame, {0, 40}, 10), (PictureHit{1, 0}));  // outside the picture
}

TEST(PictureHit, OfTwoInOnePlaceItIsThePreferredPersons) {
  const FrameLabels frame = TwoPeople();
  EXPECT_EQ(HitLandmark(frame, {121, 100}, 10, 0), (PictureHit{0, 1}));
  EXPECT_EQ(HitLandmark(frame, {121, 100}, 10, 1), (PictureHit{1, 1}));
}

TEST(PictureHit, AbsentOnesAreNotThere) {
  FrameLabels frame = TwoPeople();
  frame.people[0].landmarks[0].state = LabelState::kAbsent;
  EXPECT_FALSE(HitLandmark(frame, {100, 100}, 10));
}

}  // namespace
}  // namespace poselift
