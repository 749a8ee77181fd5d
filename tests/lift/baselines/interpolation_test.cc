// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Curves with entries taken out. The spline against SciPy and against what
// defines it: its cubics, read back from the frames that were filled, meet with
// equal slope and second derivative and end straight.
#include "lift/baselines/interpolation.h"

#include <gmock/gmock.h>

#include <Eigen/LU>

#include "src/input_error.h"
#include "tests/support/motion_curves.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::kInfinity;
using testing::kNaN;
using testing::MatrixNear;
using testing::SameCurves;
using testing::SampleCurve;

// The curve at these frames alone.
Eigen::RowVectorXd Keep(const Eigen::RowVectorXd& curve, const std::vector<Eigen::Index>& frames) {
  Eigen::RowVectorXd kept = Eigen::RowVectorXd::Constant(curve.size(), kNaN);
  for (const Eigen::Index t : frames) kept[t] = curve[t];
  return kept;
}

// The cubic through the first four frames from `start` on: p(start + u) = sum_d c_d u^d.
Eigen::Vector4d Cubic(const Eigen::RowVectorXd& curve, Eigen::Index start) {
  Eigen::Matrix4d powers;
  for (int u = 0; u < 4; ++u) powers.row(u) << 1, u, u * u, u * u * u;
  return powers.inverse() * curve.segment(start, 4).transpose();
}

TEST(Interpolation, LinearDividesTheGapEvenly) {
  Eigen::MatrixXd curves(2, 6);
  curves << 1, kNaN, kNaN, 7, kNaN, 5,  //
      0, kNaN, kNaN, kNaN, kNaN, -10;
  Eigen::MatrixXd expected(2, 6);
  expected << 1, 3, 5, 7, 6, 5,  //
      0, -2, -4, -6, -8, -10;
  EXPECT_TRUE(MatrixNear(FillGaps(curves, GapFill::kLinear).curves, expected, 1e-14));
}

// python3 -c "import numpy as np; from scipy.interpolate import CubicSpline
// t = np.arange(20); x = np.sin(.3*t) + .5*np.cos(1.7*t) + .01*t**2; k = [2, 3, 7, 8, 9, 13, 19]
// print(CubicSpline(k, x[k], bc_type='natural')(t[2:]).tolist())"  # SciPy 1.10.1
TEST(Interpolation, SplineIsThatOfSciPy) {
  Eigen::RowVectorXd scipy(18);
  scipy << 0.12124337710530467, 1.0623157809839736, 1.6096088012001928, 1.8052727624069431,
      1.800440416336064, 1.7462445147193935, 1.5713151767777256, 0.7784144900266841,
      0.21843566641783377, 0.06266947060549694, 0.19647043083493165, 0.5051930753513951,
      0.8916251717889285, 1.3282874453367015, 1.8051338605726661, 2.3121183820747744,
      2.839194974420978, 3.3763176021892303;
  const Eigen::RowVectorXd kept = Keep(SampleCurve(20), {2, 3, 7, 8, 9, 13, 19});
  EXPECT_TRUE(MatrixNear(FillGaps(kept).curves.rightCols(18), scipy, 1e-13));
}

TEST(Interpolation, CubicsOfTheSplineMeetSmoothlyAndEndStraight) {
  const std::vector<Eigen::Index> knots = {0, 3, 8, 12, 15, 22};
  const Eigen::RowVectorXd filled = FillGaps(Keep(SampleCurve(23), knots)).curves;
  Eigen::Vector2d end_of_last(Cubic(filled, 0)[1], 0.0);  // x' and x''
  for (size_t i = 0; i + 1 < knots.size(); ++i) {
    const Eigen::Vector4d c = Cubic(filled, knots[i]);
    const auto h = static_cast<double>(knots[i + 1] - knots[i]);
    EXPECT_NEAR(c[1], end_of_last[0], 1e-12);
    EXPECT_NEAR(2.0 * c[2], end_of_last[1], 1e-12);
    end_of_last << c[1] + 2.0 * c[2] * h + 3.0 * c[3] * h * h, 2.0 * c[2] + 6.0 * c[3] * h;
  }
  EXPECT_NEAR(end_of_last[1], 0.0, 1e-12);
}

TEST(Interpolation, AStraightLineComesBackFromAnyOfItsFrames) {
  const Eigen::RowVectorXd line = Eigen::RowVectorXd::LinSpaced(12, -3.0, 8.0);
  for (const GapFill method : {GapFill::kLinear, GapFill::kNaturalSpline})
    EXPECT_TRUE(MatrixNear(FillGaps(Keep(line, {0, 1, 5, 11}), method).curves, line, 1e-13));
}

TEST(Interpolation, BothEndsHoldTheNearestValue) {
  const Eigen::RowVectorXd curve = SampleCurve(10);
  for (const GapFill method : {GapFill::kLinear, GapFill::kNaturalSpline}) {
    const Eigen::RowVectorXd filled = FillGaps(Keep(curve, {3, 4, 6, 7}), method).curves;
    EXPECT_TRUE((filled.head(3).array() == curve[3]).all());
    EXPECT_TRUE((filled.tail(2).array() == curve[7]).all());
  }
}

TEST(Interpolation, ValuesStayBitForBitAndTheResultSaysWhatWasFilled) {
  Eigen::MatrixXd curves(3, 8);
  curves.row(0) = SampleCurve(8);
  curves.row(1) = Keep(SampleCurve(8), {1, 2, 6});
  curves.row(2) = Keep(SampleCurve(8), {5});
  for (const GapFill method : {GapFill::kLinear, GapFill::kNaturalSpline}) {
    const FilledCurves result = FillGaps(curves, method);
    EXPECT_TRUE((result.filled == curves.array().isNaN()).all());
    EXPECT_TRUE(result.curves.allFinite());
    EXPECT_TRUE((result.filled || result.curves.array() == curves.array()).all());
    EXPECT_TRUE((result.curves.row(2).array() == curves(2, 5)).all());
    EXPECT_THAT(result.empty_channels, IsEmpty());
  }
}

TEST(Interpolation, AChannelWithoutAnyValueStaysMissingAndIsNamed) {
  Eigen::MatrixXd curves = Eigen::MatrixXd::Constant(4, 5, kNaN);
  curves(1, 2) = 6.0;
  for (const GapFill method : {GapFill::kLinear, GapFill::kNaturalSpline}) {
    const FilledCurves result = FillGaps(curves, method);
    EXPECT_THAT(result.empty_channels, ElementsAre(0, 2, 3));
    EXPECT_EQ(result.filled.count(), 4);
    EXPECT_TRUE((result.curves.row(1).array() == 6.0).all());
    EXPECT_EQ(result.curves.array().isNaN().count(), 15);
  }
}

TEST(Interpolation, NoneOneOrTwoFramesAreEnough) {
  EXPECT_EQ(FillGaps(Eigen::MatrixXd(3, 0)).empty_channels.size(), 3u);
  EXPECT_EQ(FillGaps(Eigen::MatrixXd(0, 4)).curves.cols(), 4);
  for (const GapFill method : {GapFill::kLinear, GapFill::kNaturalSpline}) {
    EXPECT_EQ(FillGaps(Eigen::MatrixXd::Constant(1, 1, 2.5), method).curves(0, 0), 2.5);
    EXPECT_TRUE(SameCurves(FillGaps(Eigen::RowVector2d(1.0, -4.0), method).curves,
                           Eigen::RowVector2d(1.0, -4.0)));
    EXPECT_TRUE(SameCurves(FillGaps(Eigen::RowVector2d(kNaN, -4.0), method).curves,
                           Eigen::RowVector2d(-4.0, -4.0)));
  }
}

TEST(Interpolation, GapsUpToTheLongestAreFilledAndLongerOnesStay) {
  Eigen::RowVectorXd curve(12);
  curve << kNaN, kNaN, 2, kNaN, kNaN, 5, kNaN, kNaN, kNaN, 9, 10, kNaN;
  for (const GapFill method : {GapFill::kLinear, GapFill::kNaturalSpline}) {
    const FilledCurves two = FillGaps(curve, method, 2);
    Eigen::RowVectorXd expected(12);
    expected << 2, 2, 2, 3, 4, 5, kNaN, kNaN, kNaN, 9, 10, 10;
    EXPECT_TRUE((two.curves.array().isNaN() == expected.array().isNaN()).all());
    EXPECT_TRUE(MatrixNear(two.curves.leftCols(6), expected.leftCols(6), 1e-12));
    EXPECT_EQ(two.curves(0, 11), 10.0);
    EXPECT_EQ(two.filled.count(), 5);
    EXPECT_TRUE(FillGaps(curve, method, 3).curves.allFinite());
    EXPECT_TRUE(SameCurves(FillGaps(curve, method, 0).curves, curve));
    // The ends as well.
    EXPECT_EQ(FillGaps(curve, method, 1).curves.array().isNaN().count(), 7);
  }
  EXPECT_THROW(FillGaps(curve, GapFill::kLinear, -1), InputError);
}

// What lies beyond a long gap has no say.
TEST(Interpolation, TheSplineEndsAtALongGap) {
  Eigen::RowVectorXd curve = Keep(SampleCurve(30), {0, 2, 5, 9, 20, 23, 29});
  const Eigen::RowVectorXd before = FillGaps(curve, GapFill::kNaturalSpline, 6).curves;
  curve.tail(10) *= -100.0;
  const Eigen::RowVectorXd after = FillGaps(curve, GapFill::kNaturalSpline, 6).curves;
  EXPECT_TRUE(SameCurves(before.head(20), after.head(20)));
  EXPECT_TRUE(
      SameCurves(before.head(10), FillGaps(Keep(SampleCurve(30), {0, 2, 5, 9}).head(10)).curves));
}

TEST(Interpolation, AnInfiniteEntryIsRefused) {
  EXPECT_THROW(FillGaps(Eigen::RowVector3d(0.0, kNaN, kInfinity)), InputError);
}

}  // namespace
}  // namespace poselift
