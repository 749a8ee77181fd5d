// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Polynomials, impulses and a curve smoothed by SciPy.
#include "lift/baselines/savitzky_golay.h"

#include <gtest/gtest.h>

#include "src/input_error.h"
#include "tests/support/motion_curves.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::kInfinity;
using testing::kNaN;
using testing::MatrixNear;
using testing::SameCurves;
using testing::SampleCurve;

// sum_d u^d / (d + 1) of the given degree, u from -1 to 1.
Eigen::RowVectorXd Polynomial(int degree, Eigen::Index num_frames) {
  const Eigen::ArrayXd u = Eigen::ArrayXd::LinSpaced(num_frames, -1.0, 1.0);
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(num_frames);
  for (int d = 0; d <= degree; ++d) sum += u.pow(d) / (d + 1.0);
  return sum.matrix().transpose();
}

TEST(SavitzkyGolay, PolynomialsUpToTheDegreeComeBackAtEveryFrame) {
  for (int degree = 0; degree <= 6; ++degree)
    for (const Eigen::Index num_frames : {11, 12, 40}) {
      const Eigen::MatrixXd x = Polynomial(degree, num_frames);
      EXPECT_TRUE(MatrixNear(SavitzkyGolay(x, {.window_frames = 11, .degree = degree}), x, 1e-12));
    }
}

TEST(SavitzkyGolay, APolynomialAboveTheDegreeDoesNot) {
  const Eigen::MatrixXd x = Polynomial(4, 40);
  const Eigen::MatrixXd change = SavitzkyGolay(x, {.window_frames = 11, .degree = 2}) - x;
  EXPECT_GT(change.cwiseAbs().minCoeff(), 1e-6);
}

// (-3, 12, 17, 12, -3) / 35: table I of the paper, and its neighbours at the edge.
TEST(SavitzkyGolay, FivePointsOfDegreeTwoHaveTheWeightsOfThePaper) {
  Eigen::MatrixXd impulses = Eigen::MatrixXd::Identity(9, 9);
  const Eigen::MatrixXd weights = SavitzkyGolay(impulses, {.window_frames = 5, .degree = 2});
  Eigen::VectorXd expected(9);
  expected << 0, 0, -3, 12, 17, 12, -3, 0, 0;
  EXPECT_TRUE(MatrixNear(weights.col(4), expected / 35.0, 1e-14));
  expected << 31, 9, -3, -5, 3, 0, 0, 0, 0;
  EXPECT_TRUE(MatrixNear(weights.col(0), expected / 35.0, 1e-14));
  expected << 9, 13, 12, 6, -5, 0, 0, 0, 0;
  EXPECT_TRUE(MatrixNear(weights.col(1), expected / 35.0, 1e-14));
  EXPECT_TRUE(MatrixNear(weights.col(7), expected.reverse() / 35.0, 1e-14));
}

// python3 -c "import numpy as np; from scipy.signal import savgol_filter
// t = np.arange(20); x = np.sin(.3*t) + .5*np.cos(1.7*t) + .01*t**2
// print(savgol_filter(x, 7, 3).tolist())"  # SciPy 1.10.1
TEST(SavitzkyGolay, ACurveComesOutAsInSciPy) {
  Eigen::RowVectorXd scipy(20);
  scipy << 0.47747170014788476, 0.19212225234297553, 0.40840988607447404, 0.8539728138556648,
      1.0504373006148784, 1.2707953734388555, 1.3621954007465087, 1.3155261775429654,
      1.290552174889792, 1.276573115921717, 1.1528251648536247, 1.0090191243482183,
      0.9980621208775424, 1.0485351266945897, 1.0809089948211315, 1.2344397746427345,
      1.5882552222403796, 1.8127944178814057, 2.3788986211377803, 3.5278764242601626;
  EXPECT_TRUE(
      MatrixNear(SavitzkyGolay(SampleCurve(20), {.window_frames = 7, .degree = 3}), scipy, 1e-12));
}

TEST(SavitzkyGolay, AFullDegreeOrAWindowOfOneSmoothsNothing) {
  const Eigen::MatrixXd x = SampleCurve(30);
  EXPECT_TRUE(MatrixNear(SavitzkyGolay(x, {.window_frames = 5, .degree = 4}), x, 1e-13));
  EXPECT_TRUE(MatrixNear(SavitzkyGolay(x, {.window_frames = 1, .degree = 0}), x, 1e-13));
}

TEST(SavitzkyGolay, FewerFramesThanAWindowAreOneWindow) {
  for (const Eigen::Index num_frames : {0, 1, 2, 4})
    EXPECT_TRUE(MatrixNear(SavitzkyGolay(SampleCurve(num_frames), {.window_frames = 11}),
                           SampleCurve(num_frames), 1e-13));
  const Eigen::MatrixXd mean = SavitzkyGolay(SampleCurve(6), {.window_frames = 11, .degree = 0});
  EXPECT_TRUE(MatrixNear(mean, Eigen::MatrixXd::Constant(1, 6, SampleCurve(6).mean()), 1e-13));
  EXPECT_TRUE(MatrixNear(SavitzkyGolay(SampleCurve(9), {.window_frames = 101}),
                         SavitzkyGolay(SampleCurve(9), {.window_frames = 9}), 1e-13));
}

TEST(SavitzkyGolay, AConstantStays) {
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(3, 50, 2.25);
  EXPECT_TRUE(MatrixNear(SavitzkyGolay(constant), constant, 1e-13));
}

TEST(SavitzkyGolay, GapsStayAndDoNotSpread) {
  const Eigen::MatrixXd x = SampleCurve(40);
  Eigen::MatrixXd gappy(2, 40);
  gappy << x, Eigen::MatrixXd::Constant(1, 40, kNaN);
  gappy.middleCols(6, 2).setConstant(kNaN);
  Eigen::MatrixXd expected = gappy;
  expected.row(0).head(6) = SavitzkyGolay(x.leftCols(6));
  expected.row(0).tail(32) = SavitzkyGolay(x.rightCols(32));
  EXPECT_TRUE(SameCurves(SavitzkyGolay(gappy), expected));
}

TEST(SavitzkyGolay, BadOptionsAreRefused) {
  EXPECT_EQ(SavitzkyGolayOptions().Validate(), "");
  for (const SavitzkyGolayOptions& bad : {SavitzkyGolayOptions{.window_frames = 0, .degree = 0},
                                          {.window_frames = -5, .degree = 0},
                                          {.window_frames = 8, .degree = 2},
                                          {.window_frames = 7, .degree = 7},
                                          {.window_frames = 7, .degree = -1}}) {
    EXPECT_NE(bad.Validate(), "");
    EXPECT_THROW(SavitzkyGolay(SampleCurve(20), bad), InputError);
  }
  EXPECT_THROW(SavitzkyGolay(Eigen::RowVector3d(1.0, kInfinity, 0.0)), InputError);
}

}  // namespace
}  // namespace poselift
