// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/point_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/support.h"

namespace poselift {
namespace {

ObservedPoint Point(const std::string& name, double x_px, double y_px) {
  ObservedPoint point;
  point.name = name;
  point.parts = {{joint::kLeftKnee, 1.0}};
  point.x = {x_px, y_px, 0.0};
  point.sigma = 3.0;
  return point;
}

// A point that moves evenly, and another that is always there.
std::vector<Observation> Frames(int count) {
  std::vector<Observation> frames;
  for (int t = 0; t < count; ++t)
    frames.push_back({{Point("knee", 10.0 * t, 100.0 - t), Point("hip", 50.0, 60.0)}});
  return frames;
}

TEST(PointCurves, FillsShortGapsByStraightLinesAndSaysSo) {
  std::vector<Observation> frames = Frames(12);
  for (const int t : {4, 5})
    frames[static_cast<size_t>(t)].points.erase(frames[static_cast<size_t>(t)].points.begin());
  const auto filled = SmoothPoints(frames, 1.0 / 30.0, 0.0, 3);
  ASSERT_EQ(filled[4].points.size(), 2U);
  const ObservedPoint& knee = filled[4].points[1];
  EXPECT_EQ(knee.name, "knee");
  EXPECT_NEAR(knee.x.x(), 40.0, 1e-9);
  EXPECT_NEAR(knee.x.y(), 96.0, 1e-9);
  EXPECT_EQ(knee.state, LabelState::kOccluded);
  EXPECT_DOUBLE_EQ(knee.sigma, 6.0);
  EXPECT_EQ(filled[3].points[0].state, LabelState::kVisible);
}

TEST(PointCurves, LeavesLongGapsAndEndsEmpty) {
  std::vector<Observation> frames = Frames(20);
  for (const size_t t : {0, 1, 6, 7, 8, 9, 19}) frames[t].points.erase(frames[t].points.begin());
  const auto filled = SmoothPoints(frames, 1.0 / 30.0, 0.0, 3);
  for (const size_t t : {0, 1, 6, 7, 8, 9, 19}) EXPECT_EQ(filled[t].points.size(), 1U) << t;
}

TEST(PointCurves, TakesNoiseOff) {
  auto rng = testing::TestRng();
  std::normal_distribution<double> noise(0.0, 5.0);
  std::vector<Observation> frames = Frames(120);
  for (Observation& frame : frames)
    for (ObservedPoint& point : frame.points)
      point.x.head<2>() += Eigen::Vector2d(noise(rng), noise(rng));
  const auto smooth = SmoothPoints(frames, 1.0 / 30.0, 3.0, 3);
  double squared_px = 0.0, count = 0.0;
  for (int t = 10; t < 110; ++t, count += 2.0)
    squared_px += (smooth[static_cast<size_t>(t)].points[0].x.head<2>() -
                   Eigen::Vector2d(10.0 * t, 100.0 - t))
                      .squaredNorm();
  EXPECT_LT(std::sqrt(squared_px / count), 3.2);  // sqrt(2 * 3 Hz / 30 Hz) of 5 px is 2.2
}

TEST(PointCurves, PointsInSpaceStayAsTheyAre) {
  std::vector<Observation> frames = Frames(8);
  for (Observation& frame : frames) frame.points[1].kind = ObservedPoint::Kind::k3D;
  frames[3].points.pop_back();
  const auto smooth = SmoothPoints(frames, 1.0 / 30.0, 0.0, 3);
  EXPECT_EQ(smooth[3].points.size(), 1U);
  EXPECT_EQ(smooth[2].points[1].x, frames[2].points[1].x);
}

}  // namespace
}  // namespace poselift
