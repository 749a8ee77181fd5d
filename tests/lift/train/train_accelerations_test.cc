// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Segments that follow a planted linear law, found again.
#include "lift/train/train_accelerations.h"

#include <gtest/gtest.h>

#include "lift/temporal/acceleration_model.h"
#include "src/input_error.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::RandomMatrix;

constexpr double kNoise = 0.05;

class TrainAccelerationsTest : public ::testing::Test {
 protected:
  // x varies along two directions about a mean; a = law (x - mean) + noise.
  TrainAccelerationsTest() {
    auto rng = testing::TestRng();
    constexpr int kCount = 4000;
    const Eigen::MatrixXd spread = 0.3 * RandomMatrix(kAccelerationInputs, 2, &rng);
    mean_ = 0.1 * RandomMatrix(kAccelerationInputs, 1, &rng);
    law_ = RandomMatrix(kNumFeatures, kAccelerationInputs, &rng);
    const Eigen::MatrixXd x = (spread * RandomMatrix(2, kCount, &rng)).colwise() + mean_;
    const Eigen::MatrixXd a =
        law_ * (x.colwise() - mean_) + kNoise * RandomMatrix(kNumFeatures, kCount, &rng);
    captured_ = Codebook(x);
    captured_.accelerations.means = a.cast<float>();
    codebook_ = Codebook((0.5 * spread * RandomMatrix(2, 5, &rng)).colwise() + mean_);
  }

  static MotionCodebook Codebook(const Eigen::MatrixXd& x) {
    MotionCodebook codebook;
    codebook.skeleton = testing::TrimmedCmuLikeSkeleton();
    codebook.segments.setZero(kSegmentRows, x.cols());
    codebook.segments.middleRows<kPoseRows>(kMiddleSample * kNumFeatures) =
        x.topRows<kPoseRows>().cast<float>();
    codebook.rates = x.bottomRows<kNumFeatures>().cast<float>();
    codebook.deviations.setZero(kNumFeatures, x.cols());
    codebook.accelerations = AccelerationModels::Zero(x.cols());
    return codebook;
  }

  Eigen::VectorXd mean_;
  Eigen::MatrixXd law_;
  MotionCodebook captured_, codebook_;
};

TEST_F(TrainAccelerationsTest, FindsThePlantedLaw) {
  double done = 0.0;
  TrainAccelerations(
      captured_, {.num_neighbours = 200}, [&](double share) { done = share; }, &codebook_);
  EXPECT_EQ(done, 1.0);
  const Eigen::MatrixXd expected =
      law_ * (codebook_.AccelerationInputs().cast<double>().colwise() - mean_);
  EXPECT_TRUE(testing::MatrixNear(codebook_.accelerations.means.cast<double>(), expected, 0.08));
  EXPECT_NEAR(codebook_.accelerations.deviations.mean(), kNoise, 0.1 * kNoise);
}

// Between the segments, where their means alone are far off.
TEST_F(TrainAccelerationsTest, TheModelFollowsThePlantedLaw) {
  TrainAccelerations(captured_, {.num_neighbours = 200}, {}, &codebook_);
  AccelerationModel model(codebook_);
  const Eigen::VectorXd x = codebook_.AccelerationInputs().cast<double>().rowwise().mean();
  FeatureVector pose = FeatureVector::Zero();
  pose.head<kPoseRows>() = x.head<kPoseRows>();
  const AccelerationModel::Prediction& found = model.At(pose, x.tail<kNumFeatures>());
  EXPECT_TRUE(testing::MatrixNear(found.mean, law_ * (x - mean_), 0.1));
  EXPECT_GT((codebook_.accelerations.means.col(0).cast<double>() - found.mean).norm(), 1.0);
  EXPECT_NEAR(found.variance.cwiseSqrt().mean(), kNoise, 0.5 * kNoise);
}

TEST_F(TrainAccelerationsTest, OptionsAreChecked) {
  EXPECT_THROW(TrainAccelerations(captured_, {.num_neighbours = 0}, {}, &codebook_), InputError);
  EXPECT_THROW(TrainAccelerations(captured_, {.bandwidth = 0.0}, {}, &codebook_), InputError);
  EXPECT_THROW(TrainAccelerations(captured_, {.apart = 0}, {}, &codebook_), InputError);
}

TEST_F(TrainAccelerationsTest, OneCapturedSegmentIsItsOwnModel) {
  captured_ = Codebook(mean_);
  captured_.accelerations.means.setConstant(2.0f);
  codebook_ = captured_;
  TrainAccelerations(captured_, {}, {}, &codebook_);
  EXPECT_TRUE(codebook_.accelerations.means.allFinite());
  EXPECT_TRUE(codebook_.accelerations.deviations.allFinite());
}

}  // namespace
}  // namespace poselift
