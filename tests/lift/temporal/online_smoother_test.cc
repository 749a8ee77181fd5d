// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/online_smoother.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "lift/baselines/one_euro.h"
#include "lift/online_smoothing.h"
#include "lift/temporal/pose_difference.h"
#include "lift/train/train_accelerations.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Kind = SmoothedFrame::Kind;

constexpr double kNoise = 0.05;  // radians and metres

class OnlineSmootherTest : public ::testing::Test {
 protected:
  OnlineSmootherTest() : walk_(testing::MadeUpGaits().Gait(160, 0.55)), noisy_(walk_) {
    const MotionCodebook captured = SegmentsOf(testing::MadeUpGaits().Database(5, 160), 2);
    codebook_ = std::make_shared<MotionCodebook>(captured);
    TrainAccelerations(captured, {.num_neighbours = 20, .apart = 2}, {}, codebook_.get());
    auto rng = testing::TestRng();
    std::normal_distribution<double> noise(0.0, kNoise);
    for (SkeletonPose& pose : noisy_.frames)
      pose = MovedBy(pose, FeatureVector::NullaryExpr([&] { return noise(rng); }));
  }

  std::vector<SmoothedFrame> Run(const Motion& motion, const MotionFilterOptions& options) const {
    OnlineSmoother smoother(codebook_, options);
    std::vector<SmoothedFrame> frames;
    for (size_t t = 0; t < motion.frames.size(); ++t) {
      smoother.Add(TimeOf(motion, t), motion.frames[t]);
      while (auto frame = smoother.Take()) frames.push_back(*frame);
    }
    smoother.End();
    while (auto frame = smoother.Take()) frames.push_back(*frame);
    return frames;
  }

  static double TimeOf(const Motion& motion, size_t t) {
    return static_cast<double>(t) * motion.frame_time_s;
  }

  // Mean distance of the joints over the frames from `first` on.
  double Error_mm(const std::vector<SkeletonPose>& poses, size_t first) const {
    double sum_m = 0.0;
    for (size_t t = first; t < poses.size(); ++t)
      sum_m += (JointPositions(walk_.skeleton, poses[t]) -
                JointPositions(walk_.skeleton, walk_.frames[t]))
                   .colwise()
                   .norm()
                   .mean();
    return 1e3 * sum_m / static_cast<double>(poses.size() - first);
  }
  double Error_mm(const std::vector<SmoothedFrame>& frames, size_t first) const {
    std::vector<SkeletonPose> poses;
    for (const SmoothedFrame& frame : frames) poses.push_back(frame.pose);
    return Error_mm(poses, first);
  }

  Motion walk_, noisy_;
  std::shared_ptr<MotionCodebook> codebook_;
};

constexpr size_t kWarmUp = 15;

TEST_F(OnlineSmootherTest, IsNearerToTheTruthTheLongerItWaits) {
  const double at_once_mm = Error_mm(Run(noisy_, {.latency_s = 0.0}), kWarmUp);
  const double late_mm = Error_mm(Run(noisy_, {.latency_s = 0.15}), kWarmUp);
  EXPECT_LT(at_once_mm, 0.75 * Error_mm(noisy_.frames, kWarmUp));
  EXPECT_LT(late_mm, 0.75 * at_once_mm);
  const MotionSmoother one_euro = SmootherOfCurves(
      GapFill::kLinear,
      [](const Eigen::MatrixXd& curves, double rate_hz) { return SmoothOneEuro(curves, rate_hz); });
  EXPECT_LT(at_once_mm, Error_mm(one_euro(noisy_, 0).frames, kWarmUp));
}

TEST_F(OnlineSmootherTest, FramesComeOutInOrderAsLateAsSaid) {
  OnlineSmoother smoother(codebook_, {.latency_s = 0.1});
  size_t taken = 0;
  for (size_t t = 0; t < 60; ++t) {
    smoother.Add(TimeOf(noisy_, t), noisy_.frames[t]);
    while (const auto frame = smoother.Take()) {
      EXPECT_EQ(frame->kind, Kind::kMeasured);
      EXPECT_EQ(frame->time_s, TimeOf(noisy_, taken++));
    }
    EXPECT_EQ(taken, t < 6 ? 0 : t - 5) << t;  // 60 Hz
  }
  smoother.End();
  while (smoother.Take()) ++taken;
  EXPECT_EQ(taken, 60u);
}

// The same frames with more of them to come: nothing is looked at but the latency.
TEST_F(OnlineSmootherTest, WhatCameOutDoesNotDependOnWhatComes) {
  Motion other = noisy_;
  for (size_t t = 100; t < other.frames.size(); ++t) other.frames[t] = other.frames[99];
  const auto a = Run(noisy_, {.latency_s = 0.1}), b = Run(other, {.latency_s = 0.1});
  for (size_t t = 0; t < 94; ++t) EXPECT_EQ(a[t].pose.dofs, b[t].pose.dofs) << t;
  EXPECT_NE(a[97].pose.dofs, b[97].pose.dofs);
}

TEST_F(OnlineSmootherTest, ShortGapsAreFilledAndLongOnesNot) {
  for (size_t t = 60; t < 72; ++t) noisy_.frames[t] = UnknownPose(walk_.skeleton);
  for (size_t t = 100; t < 140; ++t) noisy_.frames[t] = UnknownPose(walk_.skeleton);
  const auto frames = Run(noisy_, {.latency_s = 0.1, .max_gap_s = 0.25});
  for (size_t t = 0; t < frames.size(); ++t) {
    const Kind expected = (t >= 60 && t < 72) || (t >= 100 && t < 115) ? Kind::kFilled
                          : t >= 115 && t < 140                        ? Kind::kNotKnown
                                                                       : Kind::kMeasured;
    EXPECT_EQ(frames[t].kind, expected) << t;
    EXPECT_EQ(IsKnown(frames[t].pose), expected != Kind::kNotKnown) << t;
  }
  EXPECT_LT(Error_mm(std::vector<SmoothedFrame>(frames.begin(), frames.begin() + 72), 60), 150.0);
  const auto at_once = Run(noisy_, {.latency_s = 0.0});
  EXPECT_GT(at_once[71].deviations.mean(), 1.5 * at_once[59].deviations.mean());
}

// Whatever may be filled, what is measured is one motion.
TEST_F(OnlineSmootherTest, SmoothsWhenNoGapMayBeFilled) {
  const auto none = Run(noisy_, {.max_gap_s = 0.0}), usual = Run(noisy_, {});
  for (size_t t = 0; t < none.size(); ++t) EXPECT_EQ(none[t].pose.dofs, usual[t].pose.dofs) << t;
}

TEST_F(OnlineSmootherTest, UnevenTimesAreNoNoise) {
  for (double step_s : {1.0, 0.5}) {
    OnlineSmoother even(codebook_, {.latency_s = 0.0}), uneven(codebook_, {.latency_s = 0.0});
    double error_even = 0.0, error_uneven = 0.0;
    for (size_t t = 0; t < walk_.frames.size(); ++t) {
      even.Add(TimeOf(walk_, t), noisy_.frames[t]);
      error_even += (even.Take()->pose.dofs - walk_.frames[t].dofs).squaredNorm();
      if (t % 5 == 2 && step_s < 1.0) continue;  // lost by the camera
      uneven.Add(TimeOf(walk_, t), noisy_.frames[t]);
      error_uneven += (uneven.Take()->pose.dofs - walk_.frames[t].dofs).squaredNorm();
    }
    EXPECT_LT(error_uneven, 1.2 * error_even);
  }
}

TEST_F(OnlineSmootherTest, KnowsHowFarItIsOff) {
  const auto frames = Run(noisy_, {.latency_s = 0.1});
  double squares = 0.0, said = 0.0;
  for (size_t t = 40; t < frames.size(); ++t) {
    squares += (frames[t].pose.dofs - walk_.frames[t].dofs).squaredNorm();
    said += frames[t].deviations.head<kNumAngles>().squaredNorm();
  }
  EXPECT_GT(said, 0.5 * squares);
  EXPECT_LT(said, 2.0 * squares);
}

TEST_F(OnlineSmootherTest, MovesAlongWithTheWorld) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.2, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d shift_m(5.0, -1.0, 2.0);
  Motion moved = noisy_;
  for (SkeletonPose& pose : moved.frames) {
    pose.root_in_world_m = turn * pose.root_in_world_m + shift_m;
    pose.world_from_root = turn * pose.world_from_root;
  }
  const auto a = Run(noisy_, {}), b = Run(moved, {});
  for (size_t t = 0; t < a.size(); ++t) {
    EXPECT_TRUE(testing::MatrixNear(a[t].pose.dofs, b[t].pose.dofs, 1e-3));
    EXPECT_TRUE(testing::MatrixNear(turn * a[t].pose.root_in_world_m + shift_m,
                                    b[t].pose.root_in_world_m, 1e-3));
  }
}

TEST_F(OnlineSmootherTest, AWholeTurnOfAnAngleIsNoLeap) {
  const auto plain = Run(noisy_, {});
  for (size_t t = 50; t < noisy_.frames.size(); ++t)
    noisy_.frames[t].dofs[3] += 2.0 * std::numbers::pi;
  const auto turned = Run(noisy_, {});
  for (size_t t = 0; t < plain.size(); ++t)
    EXPECT_NEAR(plain[t].pose.dofs[3], turned[t].pose.dofs[3], 1e-9) << t;
}

TEST_F(OnlineSmootherTest, OneWrongFrameDrawsLittle) {
  const auto plain = Run(noisy_, {});
  noisy_.frames[80].dofs.array() += 2.0;
  const auto struck = Run(noisy_, {});
  EXPECT_LT((plain[80].pose.dofs - struck[80].pose.dofs).cwiseAbs().maxCoeff(), 0.3);
  EXPECT_LT((plain[120].pose.dofs - struck[120].pose.dofs).cwiseAbs().maxCoeff(), 0.05);
}

TEST_F(OnlineSmootherTest, RefusesWhatIsWrong) {
  EXPECT_THROW(OnlineSmoother(codebook_, {.latency_s = -1.0}), InputError);
  EXPECT_THROW(OnlineSmoother(codebook_, {.variance_scale = 0.0}), InputError);
  EXPECT_THROW(OnlineSmoother(codebook_, {.max_gap_s = 1e6}), InputError);
  OnlineSmoother smoother(codebook_);
  smoother.Add(1.0, noisy_.frames[0]);
  EXPECT_THROW(smoother.Add(1.0, noisy_.frames[1]), InputError);
}

TEST_F(OnlineSmootherTest, AMotionIsSmoothedAsItsStream) {
  const MotionSmoother as_it_is = [](const Motion& motion, int) { return motion; };
  const Motion whole = SmootherOnline(codebook_, as_it_is, {.latency_s = 0.05})(noisy_, 15);
  const auto frames = Run(noisy_, {.latency_s = 0.05, .max_gap_s = 0.25});
  ASSERT_EQ(whole.frames.size(), frames.size());
  for (size_t t = 0; t < frames.size(); ++t)
    EXPECT_TRUE(testing::MatrixNear(whole.frames[t].dofs, frames[t].pose.dofs, 1e-6)) << t;
}

}  // namespace
}  // namespace poselift
