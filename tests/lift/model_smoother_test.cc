// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/model_smoother.h"

#include <gtest/gtest.h>

#include <random>

#include "lift/baselines/butterworth.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr double kNoise = 0.03;  // radians and metres

class ModelSmootherTest : public ::testing::Test {
 protected:
  ModelSmootherTest() : walk_(testing::MadeUpGaits().Gait(160, 0.55)), noisy_(walk_) {
    codebook_ =
        std::make_shared<MotionCodebook>(SegmentsOf(testing::MadeUpGaits().Database(5, 160), 3));
    auto rng = testing::TestRng();
    std::normal_distribution<double> noise(0.0, kNoise);
    for (SkeletonPose& pose : noisy_.frames) {
      for (double& dof : pose.dofs) dof += noise(rng);
      for (double& x : pose.root_in_world_m) x += noise(rng);
      const Eigen::Vector3d turn_rad(noise(rng), noise(rng), noise(rng));
      pose.world_from_root =
          Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()) * pose.world_from_root;
    }
  }

  double Error_mm(const Motion& motion, size_t first, size_t last) const {
    double sum_m = 0.0;
    for (size_t t = first; t <= last; ++t)
      sum_m += (JointPositions(walk_.skeleton, motion.frames[t]) -
                JointPositions(walk_.skeleton, walk_.frames[t]))
                   .colwise()
                   .norm()
                   .mean();
    return 1000.0 * sum_m / static_cast<double>(last - first + 1);
  }

  Motion walk_, noisy_;
  std::shared_ptr<MotionCodebook> codebook_;
};

TEST_F(ModelSmootherTest, IsNearerToTheTruthThanAFilter) {
  const MotionSmoother filter =
      SmootherOfCurves(GapFill::kLinear, [](const Eigen::MatrixXd& curves, double rate_hz) {
        return ButterworthLowPass(curves, rate_hz, {.cutoff_hz = 6.0});
      });
  const double by_model_mm = Error_mm(SmootherByModel(codebook_)(noisy_, 0), 0, 159);
  EXPECT_LT(by_model_mm, 0.8 * Error_mm(filter(noisy_, 0), 0, 159));
  EXPECT_LT(by_model_mm, 0.4 * Error_mm(noisy_, 0, 159));
}

TEST_F(ModelSmootherTest, FillsShortGapsAndLeavesLongOnes) {
  for (size_t t = 60; t < 72; ++t) noisy_.frames[t] = UnknownPose(walk_.skeleton);
  for (size_t t = 110; t < 140; ++t) noisy_.frames[t] = UnknownPose(walk_.skeleton);
  const Motion smooth = SmootherByModel(codebook_)(noisy_, 12);
  for (size_t t = 0; t < smooth.frames.size(); ++t)
    EXPECT_EQ(IsKnown(smooth.frames[t]), t < 110 || t >= 140) << t;
  EXPECT_LT(Error_mm(smooth, 60, 71), 40.0);
}

TEST_F(ModelSmootherTest, KnowsTheNoise) {
  const FeatureVector noise = PoseNoise(noisy_);
  EXPECT_NEAR(noise.head<kNumAngles>().mean(), kNoise, 0.15 * kNoise);
  EXPECT_NEAR(noise[feature::kHeight], kNoise, 0.15 * kNoise);
  EXPECT_NEAR(noise[feature::kTilt], kNoise, 0.25 * kNoise);  // of fewer numbers
}

TEST_F(ModelSmootherTest, TooShortToKnowTheNoiseIsNoError) {
  for (const size_t count : {1U, 2U, 3U}) {
    Motion few = noisy_;
    few.frames.resize(count);
    EXPECT_EQ(PoseNoise(few), FeatureVector::Zero());
    const Motion smooth = SmootherByModel(codebook_)(few, 0);
    ASSERT_EQ(smooth.frames.size(), count);
    EXPECT_TRUE(IsKnown(smooth.frames[0]));
  }
}

TEST_F(ModelSmootherTest, RefusesAnotherSkeleton) {
  noisy_.skeleton.bones[3].name = "something else";
  EXPECT_THROW(SmootherByModel(codebook_)(noisy_, 0), InputError);
  EXPECT_THROW(SmootherByModel(codebook_, {.num_neighbours = 0}), InputError);
}

}  // namespace
}  // namespace poselift
