// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: values at uneven times. Checked: the curves go through them, smoothly, and never beyond
// the two values around.
#include "src/monotone_curve.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace poselift {
namespace {

const std::vector<double> kTimes = {0.0, 1.0, 4.0, 4.5, 7.0};

Eigen::MatrixXd Values() {
  Eigen::MatrixXd values(3, 5);
  values << 0.0, 1.0, 2.5, 6.0, 7.0,  // goes up throughout
      1.0, -2.0, -2.0, 3.0, 0.5,      // rests, turns
      5.0, 5.0, 5.0, 5.0, 5.0;
  return values;
}

TEST(MonotoneCurve, GoesThroughItsValuesAndRestsBeyond) {
  const MonotoneCurve curve(kTimes, Values());
  for (size_t i = 0; i < kTimes.size(); ++i)
    EXPECT_TRUE(curve.At(kTimes[i]).isApprox(Values().col(static_cast<Eigen::Index>(i)), 1e-12));
  EXPECT_EQ(curve.At(-1.0), Values().col(0));
  EXPECT_EQ(curve.At(9.0), Values().col(4));
}

TEST(MonotoneCurve, StaysBetweenTheValuesAround) {
  const MonotoneCurve curve(kTimes, Values());
  for (size_t i = 1; i < kTimes.size(); ++i)
    for (int percent = 0; percent <= 100; ++percent) {
      const Eigen::VectorXd now =
          curve.At(kTimes[i - 1] + percent / 100.0 * (kTimes[i] - kTimes[i - 1]));
      const auto behind = static_cast<Eigen::Index>(i);
      for (Eigen::Index row = 0; row < 3; ++row) {
        const auto [low, high] = std::minmax({Values()(row, behind - 1), Values()(row, behind)});
        EXPECT_GE(now[row], low - 1e-12) << row << " in step " << i;
        EXPECT_LE(now[row], high + 1e-12) << row << " in step " << i;
      }
    }
}

TEST(MonotoneCurve, IsSmoothAndLevelWhereItTurnsAndEnds) {
  const MonotoneCurve curve(kTimes, Values());
  constexpr double kStep = 1e-6;
  for (const double time : kTimes) {
    const Eigen::VectorXd before = (curve.At(time) - curve.At(time - kStep)) / kStep;
    const Eigen::VectorXd behind = (curve.At(time + kStep) - curve.At(time)) / kStep;
    EXPECT_LT((behind - before).cwiseAbs().maxCoeff(), 1e-4) << time;
    const bool is_end = time == kTimes.front() || time == kTimes.back();
    EXPECT_EQ(before.norm() < 1e-4, is_end) << time;
    EXPECT_NEAR(before[1], 0.0, 1e-4) << time;
  }
}

TEST(MonotoneCurve, OfTwoValuesGoesHalfWayInHalfTheTime) {
  const MonotoneCurve curve({1.0, 3.0}, Eigen::RowVector2d(2.0, 4.0));
  EXPECT_DOUBLE_EQ(curve.At(2.0)[0], 3.0);
  EXPECT_EQ(MonotoneCurve({1.0}, Eigen::Vector2d(2.0, 4.0)).At(1.0), Eigen::Vector2d(2.0, 4.0));
}

}  // namespace
}  // namespace poselift
