// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up gaits and a codebook of their like. What OnlineSmootherTest does not show: what is
// measured goes in as it is, the filter starts anew, looks ahead, and takes bodies of any size.
#include "lift/temporal/motion_filter.h"

#include <gtest/gtest.h>

#include "lift/body_proportions.h"
#include "lift/temporal/pose_difference.h"
#include "lift/train/train_accelerations.h"
#include "src/input_error.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Kind = SmoothedFrame::Kind;

class MotionFilterTest : public ::testing::Test {
 protected:
  MotionFilterTest() : walk_(testing::MadeUpGaits().Gait(60, 0.55)) {
    const MotionCodebook captured = SegmentsOf(testing::MadeUpGaits().Database(5, 160), 2);
    codebook_ = std::make_shared<MotionCodebook>(captured);
    TrainAccelerations(captured, {.num_neighbours = 20, .apart = 2}, {}, codebook_.get());
  }

  double TimeOf(size_t t) const { return static_cast<double>(t) * walk_.frame_time_s; }

  // Measured to variance_ each time.
  void Follow(size_t num_frames, MotionFilter* filter) const {
    for (size_t t = 0; t < num_frames; ++t) {
      filter->Next(TimeOf(t), true);
      filter->Measure(walk_.frames[t], FeatureVector::Constant(variance_));
      filter->Take();
    }
  }

  const double variance_ = 1e-6;
  Motion walk_;
  std::shared_ptr<MotionCodebook> codebook_;
};

TEST_F(MotionFilterTest, WhatIsMeasuredSurelyIsForetoldWell) {
  MotionFilter filter(codebook_, walk_.skeleton, {.latency_s = 0.0});
  Follow(30, &filter);
  const auto prediction = filter.Next(TimeOf(30), true);
  ASSERT_TRUE(prediction);
  const double moved = PoseDifference(walk_.frames[30], walk_.frames[29]).norm();
  EXPECT_LT(PoseDifference(walk_.frames[30], prediction->pose).norm(), 0.5 * moved);
  EXPECT_GT(prediction->variances.minCoeff(), variance_);
  filter.Measure(walk_.frames[30], FeatureVector::Constant(variance_));
  const auto frame = filter.Take();
  ASSERT_TRUE(frame);
  EXPECT_LT(PoseDifference(frame->pose, walk_.frames[30]).norm(), 1e-12);
  EXPECT_NEAR(frame->deviations.maxCoeff(), 1e-3, 1e-9);
}

TEST_F(MotionFilterTest, LooksAheadByTheRates) {
  MotionFilter filter(codebook_, walk_.skeleton, {.latency_s = 0.0});
  EXPECT_FALSE(filter.Ahead(0.0));
  Follow(30, &filter);
  const auto ahead = filter.Ahead(TimeOf(30));
  ASSERT_TRUE(ahead);
  const double moved = PoseDifference(walk_.frames[30], walk_.frames[29]).norm();
  EXPECT_LT(PoseDifference(walk_.frames[30], *ahead).norm(), 0.7 * moved);
}

TEST_F(MotionFilterTest, StartedAnewItForgetsWhatItForetold) {
  MotionFilter filter(codebook_, walk_.skeleton, {.latency_s = 0.0});
  Follow(30, &filter);
  filter.Next(TimeOf(30), true);
  filter.StartAnew();
  filter.Measure(walk_.frames[5], FeatureVector::Constant(variance_));
  EXPECT_EQ(filter.Take()->kind, Kind::kMeasured);
  // At rest until something moves: nothing of the jump is taken for a rate.
  const auto ahead = filter.Ahead(TimeOf(31));
  ASSERT_TRUE(ahead);
  EXPECT_LT(PoseDifference(*ahead, walk_.frames[5]).norm(), 1e-9);
}

TEST_F(MotionFilterTest, ABodyTwiceAsLargeIsForetoldAlike) {
  const Skeleton large = WithProportions(walk_.skeleton, GroupVector::Constant(std::log(2.0)));
  MotionFilter small_filter(codebook_, walk_.skeleton, {.latency_s = 0.0});
  MotionFilter large_filter(codebook_, large, {.latency_s = 0.0});
  for (size_t t = 0; t < 30; ++t) {
    SkeletonPose pose = walk_.frames[t];
    small_filter.Next(TimeOf(t), true);
    small_filter.Measure(pose, FeatureVector::Constant(variance_));
    pose.root_in_world_m *= 2.0;
    large_filter.Next(TimeOf(t), true);
    large_filter.Measure(pose, FeatureVector::Constant(variance_));
  }
  const auto small_body = small_filter.Next(TimeOf(30), false);
  const auto large_body = large_filter.Next(TimeOf(30), false);
  ASSERT_TRUE(small_body && large_body);
  EXPECT_LT((small_body->pose.dofs - large_body->pose.dofs).norm(), 1e-3);
  EXPECT_LT((2.0 * small_body->pose.root_in_world_m - large_body->pose.root_in_world_m).norm(),
            1e-2);
}

TEST_F(MotionFilterTest, WrongOptionsAndTimesAreRefused) {
  EXPECT_THROW(MotionFilter(codebook_, walk_.skeleton, {.latency_s = -1.0}), InputError);
  MotionFilter filter(codebook_, walk_.skeleton, {});
  filter.Next(1.0, false);
  EXPECT_THROW(filter.Next(1.0, false), InputError);
}

}  // namespace
}  // namespace poselift
