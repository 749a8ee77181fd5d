// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Steps worked out by hand, the plain exponential filter, and the lag behind a
// ramp, which has a closed form.
#include "lift/baselines/one_euro.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "src/input_error.h"
#include "tests/support/motion_curves.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using std::numbers::pi;
using ::testing::HasSubstr;
using testing::kInfinity;
using testing::kNaN;
using testing::MatrixNear;
using testing::SameCurves;
using testing::SampleCurve;
using ::testing::ThrowsMessage;

// At 2 Hz every alpha of these is a fraction.
const OneEuroOptions kByHand{
    .min_cutoff_hz = 1.0 / pi, .beta = 1.0 / pi, .derivative_cutoff_hz = 2.0 / pi};

// How far the result is behind a ramp, in the end.
double LagBehindRamp(double per_second, const OneEuroOptions& options) {
  constexpr double kRate_hz = 30.0;
  constexpr Eigen::Index kFrames = 900;
  const Eigen::MatrixXd ramp =
      Eigen::RowVectorXd::LinSpaced(kFrames, 0.0, per_second * (kFrames - 1) / kRate_hz);
  return (ramp - SmoothOneEuro(ramp, kRate_hz, options))(0, kFrames - 1);
}

// dx = 2, dx^ = 4/3, alpha = 7/10; then dx = 3/5, dx^ = 38/45, alpha = 83/128.
TEST(OneEuro, StepsAreThoseWorkedOutByHand) {
  const Eigen::RowVector3d smoothed = SmoothOneEuro(Eigen::RowVector3d(0, 1, 1), 2.0, kByHand);
  EXPECT_TRUE(MatrixNear(smoothed, Eigen::RowVector3d(0.0, 0.7, 229.0 / 256.0), 1e-15));
}

// After a second: dx = 1, dx^ = 4/5, alpha = 18/23.
TEST(OneEuro, AMissingFrameStaysMissingAndLengthensTheNextStep) {
  const Eigen::RowVector4d x(kNaN, 0.0, kNaN, 1.0);
  const Eigen::MatrixXd smoothed = SmoothOneEuro(x, 2.0, kByHand);
  EXPECT_TRUE(smoothed.leftCols(3).array().isNaN().cast<int>().matrix() ==
              Eigen::RowVector3i(1, 0, 1));
  EXPECT_EQ(smoothed(0, 1), 0.0);
  EXPECT_NEAR(smoothed(0, 3), 18.0 / 23.0, 1e-15);
}

TEST(OneEuro, WithBetaZeroItIsTheExponentialFilter) {
  const Eigen::RowVectorXd x = SampleCurve(100);
  const double alpha = 1.0 - 1.0 / (1.0 + 2.0 * pi * 1.5 / 30.0);
  Eigen::RowVectorXd expected = x;
  for (Eigen::Index t = 1; t < x.size(); ++t)
    expected[t] = alpha * x[t] + (1.0 - alpha) * expected[t - 1];
  for (const double derivative_cutoff_hz : {0.1, 10.0})
    EXPECT_TRUE(MatrixNear(
        SmoothOneEuro(
            x, 30.0,
            {.min_cutoff_hz = 1.5, .beta = 0.0, .derivative_cutoff_hz = derivative_cutoff_hz}),
        expected, 1e-13));
}

// In the end dx^ = v + e / dt for the lag e behind a ramp of slope v, and
// e = v / (2 pi cutoff): (beta / dt) e^2 + (min_cutoff + beta v) e = v / (2 pi).
TEST(OneEuro, LagAtSpeedIsThatOfTheClosedFormAndFallsWithBeta) {
  double before = kInfinity;
  for (const double beta : {0.0, 0.1, 1.0, 10.0}) {
    const double v = 3.0;
    const double a = 30.0 * beta;
    const double b = 1.0 + beta * v;
    const double e = 2.0 * (v / (2.0 * pi)) / (b + std::sqrt(b * b + 4.0 * a * v / (2.0 * pi)));
    const double lag = LagBehindRamp(v, {.min_cutoff_hz = 1.0, .beta = beta});
    EXPECT_NEAR(lag, e, 1e-9);
    EXPECT_NEAR(LagBehindRamp(-v, {.min_cutoff_hz = 1.0, .beta = beta}), -lag, 1e-12);
    EXPECT_LT(lag, 0.8 * before);
    before = lag;
  }
}

TEST(OneEuro, FrameByFrameIsTheWholeMatrixAndResetForgets) {
  Eigen::MatrixXd curves(3, 40);
  curves << SampleCurve(40), 2.0 * SampleCurve(40), SampleCurve(40).reverse();
  curves(1, 7) = kNaN;
  const Eigen::MatrixXd whole = SmoothOneEuro(curves, 30.0);
  OneEuroFilter filter(30.0);
  for (int round = 0; round < 2; ++round) {
    for (Eigen::Index t = 0; t < curves.cols(); ++t)
      EXPECT_TRUE(SameCurves(filter.Step(curves.col(t)), whole.col(t)));
    filter.Reset();
  }
  EXPECT_EQ(filter.Step(Eigen::VectorXd::Constant(1, 4.0))[0], 4.0);
}

TEST(OneEuro, ChannelsDoNotSeeEachOther) {
  Eigen::MatrixXd both(2, 50);
  both << SampleCurve(50), Eigen::RowVectorXd::Constant(50, kNaN);
  Eigen::MatrixXd expected = both;
  expected.row(0) = SmoothOneEuro(SampleCurve(50), 30.0);
  EXPECT_TRUE(SameCurves(SmoothOneEuro(both, 30.0), expected));
}

TEST(OneEuro, AConstantStaysWhateverTheNumberOfFrames) {
  for (const Eigen::Index num_frames : {0, 1, 2, 100}) {
    const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(2, num_frames, 0.7);
    EXPECT_TRUE(SameCurves(SmoothOneEuro(constant, 30.0), constant));
  }
  EXPECT_EQ(SmoothOneEuro(Eigen::MatrixXd(0, 5), 30.0).cols(), 5);
}

TEST(OneEuro, BadOptionsAndFramesAreRefused) {
  EXPECT_EQ(OneEuroOptions().Validate(), "");
  for (const double bad : {-1.0, kNaN, kInfinity}) {
    EXPECT_THAT(OneEuroOptions{.min_cutoff_hz = bad}.Validate(), HasSubstr("min_cutoff_hz"));
    EXPECT_THAT(OneEuroOptions{.beta = bad}.Validate(), HasSubstr("beta"));
    EXPECT_THAT(OneEuroOptions{.derivative_cutoff_hz = bad}.Validate(), HasSubstr("derivative"));
    EXPECT_THROW(OneEuroFilter(30.0, {.beta = bad}), InputError);
    EXPECT_THROW(OneEuroFilter{bad}, InputError);
  }
  EXPECT_THROW(OneEuroFilter(30.0, {.min_cutoff_hz = 0.0}), InputError);
  EXPECT_THROW(OneEuroFilter(30.0, {.derivative_cutoff_hz = 0.0}), InputError);
  OneEuroFilter filter(30.0);
  filter.Step(Eigen::Vector2d(1.0, 2.0));
  EXPECT_THAT([&] { filter.Step(Eigen::Vector3d::Zero()); },
              ThrowsMessage<InputError>(HasSubstr("3 channels, wanted 2")));
  EXPECT_THROW(filter.Step(Eigen::Vector2d(1.0, kInfinity)), InputError);
  EXPECT_THROW(SmoothOneEuro(Eigen::RowVector2d(1.0, kInfinity), 30.0), InputError);
}

}  // namespace
}  // namespace poselift
