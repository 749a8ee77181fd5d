// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up motions at other frame times: frames that are taken as they are, and
// motions simple enough to know what lies between.
#include "lift/temporal/resample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "src/input_error.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMotion;
using testing::TestRng;

void ExpectSame(const SkeletonPose& a, const SkeletonPose& b, double tolerance) {
  EXPECT_TRUE(MatrixNear(a.root_in_world_m, b.root_in_world_m, tolerance));
  EXPECT_LT(a.world_from_root.angularDistance(b.world_from_root), 1e-7 + tolerance);
  EXPECT_TRUE(MatrixNear(a.dofs, b.dofs, tolerance));
}

// All turns and shifts go at a constant speed.
Motion SteadyMotion(int num_frames, double frame_time_s) {
  Motion motion{testing::TrimmedCmuLikeSkeleton(), frame_time_s, {}};
  for (int f = 0; f < num_frames; ++f) {
    const double t = f * frame_time_s;
    SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
    pose.root_in_world_m = t * Eigen::Vector3d(1.0, -2.0, 3.0);
    pose.world_from_root = Eigen::AngleAxisd(2.0 * t, Eigen::Vector3d(0.6, 0.0, 0.8)) *
                           Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());
    pose.dofs.setConstant(-1.5 * t);
    motion.frames.push_back(pose);
  }
  return motion;
}

TEST(Resample, TakesEverySecondFrameAsItIs) {
  auto rng = TestRng();
  for (const int num_frames : {1, 2, 7, 8}) {
    Motion motion = RandomMotion(testing::TrimmedCmuLikeSkeleton(), num_frames, &rng);
    motion.frame_time_s = 0.0083333;  // as BVH files say 120 Hz
    const Motion half = Resample(motion, 1.0 / 60.0);
    EXPECT_EQ(half.frame_time_s, 1.0 / 60.0);
    ASSERT_EQ(half.frames.size(), static_cast<size_t>((num_frames + 1) / 2));
    for (size_t f = 0; f < half.frames.size(); ++f)
      ExpectSame(half.frames[f], motion.frames[2 * f], 0.0);
  }
}

TEST(Resample, FindsSteadyMotionBetweenFrames) {
  for (const double frame_time_s : {1.0 / 100.0, 1.0 / 30.0, 1.0 / 250.0, 1.0 / 77.0}) {
    const Motion motion = SteadyMotion(50, 1.0 / 120.0);
    const Motion resampled = Resample(motion, frame_time_s);
    const Motion truth = SteadyMotion(
        static_cast<int>(std::floor(49.0 / 120.0 / frame_time_s + 1e-9)) + 1, frame_time_s);
    ASSERT_EQ(resampled.frames.size(), truth.frames.size());
    for (size_t f = 0; f < truth.frames.size(); ++f)
      ExpectSame(resampled.frames[f], truth.frames[f], 1e-9);
  }
}

TEST(Resample, GoesTheShortWayBetweenAngles) {
  constexpr double kPi = std::numbers::pi;
  Motion motion = SteadyMotion(2, 0.1);
  motion.frames[0].dofs.setConstant(kPi - 0.1);
  motion.frames[1].dofs.setConstant(-kPi + 0.1);
  const Motion resampled = Resample(motion, 0.05);
  ASSERT_EQ(resampled.frames.size(), 3u);
  for (const double angle : resampled.frames[1].dofs)
    EXPECT_NEAR(std::remainder(angle - kPi, 2.0 * kPi), 0.0, 1e-12);
}

TEST(Resample, RefusesAFrameTimeThatIsNotPositive) {
  const Motion motion = SteadyMotion(3, 0.1);
  for (const double frame_time_s : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(Resample(motion, frame_time_s), InputError);
}

TEST(Resample, UnevenTimesOfASteadyMotionGiveTheSteadyMotion) {
  const Motion fine = SteadyMotion(101, 0.01);
  std::vector<SkeletonPose> poses;
  std::vector<double> times_s;
  for (const int f : {0, 3, 4, 9, 12, 18, 20, 25, 31, 36, 40, 47, 50}) {
    poses.push_back(fine.frames[f]);
    times_s.push_back(5.0 + 0.01 * f);
  }
  const Motion even = ResampleUneven(fine.skeleton, poses, times_s, 0.05);
  ASSERT_EQ(even.frames.size(), 11u);
  for (size_t k = 0; k < even.frames.size(); ++k)
    ExpectSame(even.frames[k], fine.frames[5 * k], 1e-9);
}

TEST(Resample, NothingIsKnownInAGapOrBesideAnUnknownPose) {
  const Motion fine = SteadyMotion(101, 0.01);
  std::vector<SkeletonPose> poses;
  std::vector<double> times_s;
  for (const int f : {0, 5, 11, 15, 40, 45, 50}) {
    poses.push_back(f == 5 ? UnknownPose(fine.skeleton) : fine.frames[f]);
    times_s.push_back(0.01 * f);
  }
  const Motion even = ResampleUneven(fine.skeleton, poses, times_s, 0.05);
  std::vector<bool> known;
  for (const SkeletonPose& pose : even.frames) known.push_back(IsKnown(pose));
  EXPECT_EQ(known, (std::vector<bool>{true, false, false, true, false, false, false, false, true,
                                      true, true}));
  EXPECT_THROW(ResampleUneven(fine.skeleton, poses, times_s, 0.0), InputError);
  times_s.pop_back();
  EXPECT_THROW(ResampleUneven(fine.skeleton, poses, times_s, 0.05), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
