// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Joints on sine waves, whose shifts and differences are known.
#include "lift/eval/sequence_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace poselift {
namespace {

// Every joint its own wave of a second or more at 30 Hz, `delay` frames late.
std::vector<Pose3> Waves(int num_frames, double delay) {
  std::vector<Pose3> poses;
  for (int t = 0; t < num_frames; ++t) {
    Pose3 pose(3, kNumJoints);
    for (int i = 0; i < pose.size(); ++i)
      pose(i) = 0.1 * std::sin(0.2 / (1 + i % 4) * (t - delay) + i);
    poses.push_back(pose);
  }
  return poses;
}

TEST(JitterMm, IsTheSecondDifferenceOfTheError) {
  const auto truth = Waves(30, 0.0);
  auto estimate = truth;
  EXPECT_EQ(Jitter_mm(estimate, truth), 0.0);
  for (size_t t = 0; t < truth.size(); ++t)  // 2 mm one way, 2 mm the other: 2 + 4 + 2 mm
    estimate[t].row(1).array() += t % 2 ? 0.002 : -0.002;
  EXPECT_NEAR(Jitter_mm(estimate, truth), 8.0, 1e-9);
  for (size_t t = 0; t < truth.size(); ++t)  // an error that grows evenly does not jitter
    estimate[t] = truth[t].array() + 0.003 * static_cast<double>(t);
  EXPECT_NEAR(Jitter_mm(estimate, truth), 0.0, 1e-9);
}

TEST(LagFrames, IsTheShiftOfTheTruth) {
  const auto truth = Waves(60, 0.0);
  for (const double lag : {0.0, 2.0, -3.0, 1.0})
    EXPECT_NEAR(Lag_frames(Waves(60, lag), truth), lag, 0.05);
  EXPECT_NEAR(Lag_frames(Waves(60, 1.5), truth), 1.5, 0.05);
  EXPECT_NEAR(Lag_frames(Waves(60, -0.3), truth), -0.3, 0.05);
}

TEST(LagFrames, DoesNotMindAPoseThatIsWrongAllAlong) {
  const auto truth = Waves(60, 0.0);
  auto estimate = Waves(60, 2.0);
  for (Pose3& pose : estimate) pose.row(2).array() += 0.3;
  EXPECT_NEAR(Lag_frames(estimate, truth), 2.0, 0.05);
}

TEST(LagFrames, StaysWithinItsRangeAndIsZeroWhenNothingMoves) {
  const auto truth = Waves(60, 0.0);
  EXPECT_EQ(Lag_frames(Waves(60, 5.5), truth), kMostLag_frames);
  const std::vector<Pose3> still(20, truth[0]);
  EXPECT_EQ(Lag_frames(still, still), 0.0);
}

TEST(SequenceError, RefusesTooFewFramesAndOtherNumbers) {
  EXPECT_THROW(Jitter_mm(Waves(2, 0.0), Waves(2, 0.0)), std::invalid_argument);
  EXPECT_THROW(Jitter_mm(Waves(5, 0.0), Waves(6, 0.0)), std::invalid_argument);
  EXPECT_THROW(Lag_frames(Waves(kFewestLagFrames - 1, 0.0), Waves(kFewestLagFrames - 1, 0.0)),
               std::invalid_argument);
  EXPECT_NO_THROW(Lag_frames(Waves(kFewestLagFrames, 0.0), Waves(kFewestLagFrames, 0.0)));
}

}  // namespace
}  // namespace poselift
