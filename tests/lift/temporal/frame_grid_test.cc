// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Times of made-up cameras: exact, rounded, with frames left out, and uneven.
#include "lift/temporal/frame_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/input_error.h"

namespace poselift {
namespace {

TEST(FrameGrid, FindsTheRateBehindTimesRoundedToMilliseconds) {
  std::vector<double> times_s;
  for (int n = 0; n < 3000; ++n) times_s.push_back(std::round(1e3 * (7.0 + n / 29.97)) / 1e3);
  const FrameGrid grid = FitFrameGrid(times_s);
  ASSERT_TRUE(grid.is_even);
  EXPECT_NEAR(1.0 / grid.frame_time_s, 29.97, 1e-4);
  EXPECT_NEAR(grid.first_s, 7.0, 1e-3);
  EXPECT_EQ(grid.places.back(), 2999);
}

TEST(FrameGrid, LeavesPlacesForFramesThatAreMissing) {
  const FrameGrid grid = FitFrameGrid(std::vector<double>{0.0, 0.1, 0.2, 0.5, 0.6, 1.6});
  ASSERT_TRUE(grid.is_even);
  EXPECT_EQ(grid.places, (std::vector<int>{0, 1, 2, 5, 6, 16}));
  EXPECT_NEAR(grid.frame_time_s, 0.1, 1e-12);
}

TEST(FrameGrid, UnevenTimesHaveTheMedianStep) {
  const FrameGrid grid = FitFrameGrid(std::vector<double>{1.0, 1.03, 1.07, 1.12, 1.15, 1.19});
  EXPECT_FALSE(grid.is_even);
  EXPECT_TRUE(grid.places.empty());
  EXPECT_EQ(grid.first_s, 1.0);
  EXPECT_NEAR(grid.frame_time_s, 0.04, 1e-12);
}

TEST(FrameGrid, TimesThatAreNoneAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& times_s : std::vector<std::vector<double>>{
           {}, {1.0}, {1.0, 1.0}, {1.0, 2.0, 1.5}, {1.0, nan, 2.0}, {0.0, 1e-6, 2e-6, 1e6}})
    EXPECT_THROW(FitFrameGrid(times_s), InputError);
}

}  // namespace
}  // namespace poselift
