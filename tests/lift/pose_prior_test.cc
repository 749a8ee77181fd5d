// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The whitening against the inverse covariance of made-up poses.
#include "lift/pose_prior.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;

TEST(PosePrior, CostIsTheInverseCovariance) {
  std::mt19937_64 rng = TestRng();
  constexpr double kEps_m = 0.05;
  const Eigen::VectorXd offset = RandomMatrix(69, 1, &rng);
  const Eigen::MatrixXd poses =
      (RandomMatrix(69, 69, &rng) * RandomMatrix(69, 500, &rng)).colwise() + offset;
  const PosePrior prior = LearnPosePrior(poses, kEps_m);
  const Eigen::VectorXd mean = poses.rowwise().mean();
  const Eigen::MatrixXd centred = poses.colwise() - mean;
  const Eigen::MatrixXd covariance =
      centred * centred.transpose() / 500 + kEps_m * kEps_m * Eigen::MatrixXd::Identity(69, 69);
  EXPECT_TRUE(MatrixNear(prior.mean_m, mean, 1e-12));
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::VectorXd y = RandomMatrix(69, 1, &rng);
    const double expected = (y - mean).dot(covariance.lu().solve(y - mean));
    EXPECT_NEAR((prior.whitening * (y - mean)).squaredNorm(), expected, 1e-6 * expected);
  }
}

// The pelvis never moves, and three poses span two directions.
TEST(PosePrior, IsFiniteForPosesThatSpanFewDirections) {
  std::mt19937_64 rng = TestRng();
  Eigen::MatrixXd poses = RandomMatrix(69, 3, &rng);
  poses.topRows(3).setZero();
  const PosePrior prior = LearnPosePrior(poses, 0.015);
  EXPECT_TRUE(prior.whitening.allFinite());
  const double largest = prior.whitening.rowwise().norm().maxCoeff();
  EXPECT_LE(largest, 1 / 0.015 * (1 + 1e-6));
}

TEST(PosePrior, IsEmptyUntilItIsLearnt) {
  std::mt19937_64 rng = TestRng();
  EXPECT_TRUE(PosePrior().Empty());
  EXPECT_FALSE(LearnPosePrior(RandomMatrix(69, 10, &rng)).Empty());
}

}  // namespace
}  // namespace poselift
