// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up walk with noise and gaps put in, so that the truth is known. The
// filters are the real ones.
#include "lift/smooth_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "lift/baselines/butterworth.h"
#include "lift/baselines/savitzky_golay.h"
#include "src/input_error.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::PlantWalk;
using testing::TestRng;

Motion WithNoise(Motion motion, double sigma_rad, double sigma_m, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  for (SkeletonPose& pose : motion.frames) {
    for (double& dof : pose.dofs) dof += sigma_rad * normal(*rng);
    for (double& x : pose.root_in_world_m) x += sigma_m * normal(*rng);
  }
  return motion;
}

Motion Without(Motion motion, const std::vector<FrameSpan>& spans) {
  for (const FrameSpan& span : spans)
    for (int t = span.first; t <= span.last; ++t) motion.frames[t] = UnknownPose(motion.skeleton);
  return motion;
}

// Mean distance of the bones' tips.
double Error_mm(const Motion& a, const Motion& b, int first, int last) {
  const Eigen::MatrixXd off_m = BoneTips(a) - BoneTips(b);
  const Eigen::MatrixXd columns = off_m.middleCols(first, last - first + 1);
  return 1e3 * columns.reshaped(3, columns.size() / 3).colwise().norm().mean();
}

MotionSmoother Butterworth() {
  return SmootherOfCurves(GapFill::kNaturalSpline, [](const Eigen::MatrixXd& curves, double rate) {
    return ButterworthLowPass(curves, rate);
  });
}

MotionSmoother Unfiltered(GapFill fill) {
  return SmootherOfCurves(fill, [](const Eigen::MatrixXd& curves, double) { return curves; });
}

TEST(SmoothMotion, NoiseGoesAndTheMotionStays) {
  auto rng = TestRng();
  const Motion truth = PlantWalk(200, 0.6, 0.0).motion;
  const Motion noisy = WithNoise(truth, 0.03, 0.01, &rng);
  const MotionSmoother polynomials =
      SmootherOfCurves(GapFill::kNaturalSpline, [](const Eigen::MatrixXd& curves, double) {
        return SavitzkyGolay(curves, {.window_frames = 11, .degree = 3});
      });
  for (const MotionSmoother& smoother : {Butterworth(), polynomials}) {
    const SmoothedMotion smooth = SmoothMotion(noisy, smoother);
    EXPECT_THAT(smooth.filled, IsEmpty());
    EXPECT_THAT(smooth.unknown, IsEmpty());
    EXPECT_LT(Error_mm(smooth.motion, truth, 0, 199), 0.65 * Error_mm(noisy, truth, 0, 199));
    EXPECT_LT(smooth.jitter_after_mm, 0.2 * smooth.jitter_before_mm);
    EXPECT_NEAR(smooth.moved_mm, Error_mm(smooth.motion, noisy, 0, 199), 1e-9);
  }
}

TEST(SmoothMotion, GapsAreFilledUpToTheLongestAndTheOthersNamed) {
  const Motion truth = PlantWalk(200, 0.6, 0.0).motion;
  // 0.1 s, 0.5 s, 0.52 s and, at the end, 0.05 s.
  const std::vector<FrameSpan> gaps = {{20, 25}, {60, 89}, {120, 150}, {197, 199}};
  const SmoothedMotion smooth =
      SmoothMotion(Without(truth, gaps), Unfiltered(GapFill::kNaturalSpline));
  EXPECT_THAT(smooth.filled, ElementsAre(gaps[0], gaps[1], gaps[3]));
  EXPECT_THAT(smooth.unknown, ElementsAre(gaps[2]));
  for (const SkeletonPose& pose : smooth.motion.frames) EXPECT_TRUE(IsKnown(pose));
  EXPECT_LT(Error_mm(smooth.motion, truth, 20, 25), 35.0);
  EXPECT_LT(Error_mm(smooth.motion, truth, 90, 119), 1e-6);  // what was known stays
  // On a straight line from the last pose known to the next: no farther from
  // either than they are from each other.
  const Eigen::Vector3d from_m = truth.frames[119].root_in_world_m;
  const Eigen::Vector3d to_m = truth.frames[151].root_in_world_m;
  EXPECT_TRUE(
      testing::MatrixNear(smooth.motion.frames[135].root_in_world_m, 0.5 * (from_m + to_m), 1e-9));

  const SmoothedMotion none = SmoothMotion(Without(truth, gaps), Butterworth(), {.max_gap_s = 0.0});
  EXPECT_THAT(none.filled, IsEmpty());
  EXPECT_EQ(none.unknown, gaps);
}

// What lies beyond a gap that is too long has no say.
TEST(SmoothMotion, ALongGapPartsTheFilter) {
  const Motion whole = Without(PlantWalk(160, 0.6, 0.0).motion, {{60, 120}});
  Motion other = whole;
  for (int t = 121; t < 160; ++t) other.frames[t].root_in_world_m.x() += 5.0;
  const SmoothedMotion a = SmoothMotion(whole, Butterworth());
  const SmoothedMotion b = SmoothMotion(other, Butterworth());
  for (int t = 0; t < 60; ++t)
    EXPECT_EQ(a.motion.frames[t].root_in_world_m, b.motion.frames[t].root_in_world_m);
}

TEST(SmoothMotion, JitterIsTheSecondDifference) {
  Motion motion{testing::TrimmedCmuLikeSkeleton(), 0.01, {}};
  motion.frames.assign(9, SkeletonPose::Rest(motion.skeleton));
  for (int t = 0; t < 9; ++t) motion.frames[t].root_in_world_m.x() = 0.5 * 0.002 * t * t;
  const SmoothedMotion smooth = SmoothMotion(motion, Unfiltered(GapFill::kLinear));
  EXPECT_NEAR(smooth.jitter_before_mm, 2.0, 1e-9);
  EXPECT_NEAR(smooth.jitter_after_mm, 2.0, 1e-9);
  EXPECT_NEAR(smooth.moved_mm, 0.0, 1e-9);
  motion.frames.resize(2);
  EXPECT_EQ(SmoothMotion(motion, Unfiltered(GapFill::kLinear)).jitter_before_mm, -1.0);
}

TEST(SmoothMotion, NothingKnownAndBadOptionsAreRefused) {
  Motion motion{testing::TrimmedCmuLikeSkeleton(), 0.01, {}};
  EXPECT_THROW(SmoothMotion(motion, Butterworth()), InputError);
  motion.frames.assign(3, UnknownPose(motion.skeleton));
  EXPECT_THROW(SmoothMotion(motion, Butterworth()), InputError);
  motion.frames[1] = SkeletonPose::Rest(motion.skeleton);
  EXPECT_THROW(SmoothMotion(motion, Butterworth(), {.max_gap_s = -1.0}), InputError);
  EXPECT_EQ(SmoothMotion(motion, Butterworth()).filled.size(), 2u);
}

}  // namespace
}  // namespace poselift
