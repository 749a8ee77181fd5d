// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Poses of a planted even motion, at uneven times with gaps, on a grid: where all is linear in
// time, the frames are the motion at the grid's times.
#include "lift/temporal/pose_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "src/input_error.h"
#include "src/motion.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr double kFirst_s = 5000.0, kFrameTime_s = 1.0 / 30.0;

Skeleton Arm() {
  Skeleton skeleton;
  skeleton.bones = {{.name = "root"},
                    {.name = "arm",
                     .parent = 0,
                     .tip_m = {1, 0, 0},
                     .dofs = {{Dof::Kind::kRx}, {Dof::Kind::kTy}}}};
  return skeleton;
}

// Everything moves evenly; the angle passes from below pi to above -pi.
SkeletonPose PoseAt(double time_s) {
  const double t = time_s - kFirst_s;
  return {{t, 1.0 - t, 2.0 * t},
          Eigen::Quaterniond(Eigen::AngleAxisd(0.9 * t, Eigen::Vector3d(1, 2, 2) / 3.0)),
          Eigen::Vector2d(std::remainder(3.0 + t, 2.0 * std::numbers::pi), 0.1 * t)};
}

// A pose is taken as it is within a thousandth of a frame time; nothing is faster than 3 a s.
void ExpectSame(const SkeletonPose& a, const SkeletonPose& b) {
  constexpr double kTolerance = 3.0 * 1e-3 * kFrameTime_s;
  EXPECT_LT((a.root_in_world_m - b.root_in_world_m).norm(), kTolerance);
  EXPECT_LT(a.world_from_root.angularDistance(b.world_from_root), kTolerance);
  EXPECT_NEAR(std::remainder(a.dofs[0] - b.dofs[0], 2.0 * std::numbers::pi), 0.0, kTolerance);
  EXPECT_NEAR(a.dofs[1], b.dofs[1], kTolerance);
}

void Append(std::vector<SkeletonPose> more, std::vector<SkeletonPose>* frames) {
  frames->insert(frames->end(), more.begin(), more.end());
}

TEST(PoseGrid, OfAnEvenMotionAtUnevenTimesWithGapsIsTheMotion) {
  auto rng = testing::TestRng();
  std::uniform_real_distribution<double> step_s(0.001, 0.1);
  PoseGrid grid(Arm(), kFrameTime_s);
  std::vector<SkeletonPose> frames;
  double time_s = kFirst_s;
  for (int i = 0; i < 300; ++i, time_s += i % 50 == 0 ? 0.7 : step_s(rng))
    Append(grid.Add(time_s, PoseAt(time_s)), &frames);
  ASSERT_GT(frames.size(), 400u);
  for (size_t k = 0; k < frames.size(); ++k)
    ExpectSame(frames[k], PoseAt(kFirst_s + static_cast<double>(k) * kFrameTime_s));
}

TEST(PoseGrid, TakesPosesOfItsOwnTimesAsTheyAre) {
  PoseGrid grid(Arm(), kFrameTime_s);
  for (int k = 0; k < 1000; ++k) {
    // As files give times, in microseconds.
    const double time_s = std::round(1e6 * (kFirst_s + k * kFrameTime_s)) / 1e6;
    const auto frames = grid.Add(time_s, PoseAt(time_s));
    ASSERT_EQ(frames.size(), 1u) << k;
    EXPECT_EQ(frames[0].dofs, PoseAt(time_s).dofs);
  }
}

TEST(PoseGrid, RepeatsThePoseBeforeWhereNothingIsKnown) {
  PoseGrid grid(Arm(), kFrameTime_s);
  const auto at = [](double frame) { return kFirst_s + frame * kFrameTime_s; };
  EXPECT_TRUE(grid.Add(at(-3.5), {}).empty());
  EXPECT_TRUE(grid.Add(at(-1.2), {}).empty());
  std::vector<SkeletonPose> frames;
  for (const double known : {0.0, 1.5}) Append(grid.Add(at(known), PoseAt(at(known))), &frames);
  for (const double unknown : {2.5, 4.0, 5.2}) Append(grid.Add(at(unknown), {}), &frames);
  for (const double known : {7.5, 9.0}) Append(grid.Add(at(known), PoseAt(at(known))), &frames);
  ASSERT_EQ(frames.size(), 10u);
  for (const int k : {0, 1, 8, 9}) ExpectSame(frames[static_cast<size_t>(k)], PoseAt(at(k)));
  for (const int k : {2, 3, 4, 5, 6, 7})
    ExpectSame(frames[static_cast<size_t>(k)], PoseAt(at(1.5)));
}

TEST(PoseGrid, RefusesTimesThatDoNotGoOn) {
  PoseGrid grid(Arm(), kFrameTime_s);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(grid.Add(nan, PoseAt(kFirst_s)), InputError);
  EXPECT_EQ(grid.Add(kFirst_s, PoseAt(kFirst_s)).size(), 1u);
  for (const double time_s : {kFirst_s, kFirst_s - 1.0, nan, 1e12, HUGE_VAL})
    EXPECT_THROW(grid.Add(time_s, {}), InputError) << time_s;
  EXPECT_EQ(grid.Add(kFirst_s + kFrameTime_s, {}).size(), 1u);
  for (const double frame_time_s : {0.0, -1.0, nan})
    EXPECT_THROW(PoseGrid(Arm(), frame_time_s), InputError) << frame_time_s;
}

}  // namespace
}  // namespace poselift
