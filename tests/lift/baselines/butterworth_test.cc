// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The sections and the filtered sinusoids against the closed form of the
// magnitude, short curves against SciPy.
#include "lift/baselines/butterworth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "src/input_error.h"
#include "tests/support/motion_curves.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using std::numbers::pi;
using testing::kInfinity;
using testing::kNaN;
using testing::MatrixNear;
using testing::SameCurves;
using testing::SampleCurve;

constexpr double kRate_hz = 120.0;

// |H(f)| of one pass with the cutoff left as it is.
double Magnitude(double f_hz, int order, double cutoff_hz) {
  const double ratio = std::tan(pi * f_hz / kRate_hz) / std::tan(pi * cutoff_hz / kRate_hz);
  return 1.0 / std::sqrt(1.0 + std::pow(ratio, 2.0 * order));
}

std::complex<double> Response(const std::vector<SecondOrderSection>& sections, double f_hz) {
  const std::complex<double> delay = std::polar(1.0, -2.0 * pi * f_hz / kRate_hz);
  std::complex<double> product = 1.0;
  for (const SecondOrderSection& s : sections)
    product *= (s.b0 + delay * (s.b1 + delay * s.b2)) / (1.0 + delay * (s.a1 + delay * s.a2));
  return product;
}

Eigen::RowVectorXd Sinusoid(double f_hz, double phase, Eigen::Index num_frames) {
  Eigen::RowVectorXd curve(num_frames);
  for (Eigen::Index t = 0; t < num_frames; ++t)
    curve[t] = std::sin(2.0 * pi * f_hz * static_cast<double>(t) / kRate_hz + phase);
  return curve;
}

// What a filter makes of a sinusoid, away from both ends: amplitude and phase.
// A second holds whole periods of the frequencies used here.
std::complex<double> MeasuredResponse(double f_hz, const ButterworthOptions& options) {
  constexpr Eigen::Index kSecond = 120;
  const Eigen::RowVectorXd out =
      ButterworthLowPass(Sinusoid(f_hz, 0.0, 31 * kSecond), kRate_hz, options)
          .middleCols(15 * kSecond, kSecond);
  const double in_phase = out.dot(Sinusoid(f_hz, 0.0, kSecond));
  const double quadrature = out.dot(Sinusoid(f_hz, pi / 2.0, kSecond));
  return {in_phase * 2.0 / kSecond, quadrature * 2.0 / kSecond};
}

TEST(Butterworth, SectionsHaveTheMagnitudeOfTheClosedForm) {
  for (const int order : {2, 4, 6, 8})
    for (const double cutoff_hz : {0.5, 6.0, 29.0, 55.0}) {
      const std::vector<SecondOrderSection> sections = DesignButterworth(
          kRate_hz, {.order = order, .cutoff_hz = cutoff_hz, .zero_phase = false});
      ASSERT_EQ(sections.size(), static_cast<size_t>(order / 2));
      for (double f_hz = 0.25; f_hz < 60.0; f_hz += 0.25)
        EXPECT_NEAR(std::abs(Response(sections, f_hz)), Magnitude(f_hz, order, cutoff_hz), 1e-10);
    }
}

TEST(Butterworth, SinusoidsComeOutOfOnePassAsTheSectionsSay) {
  for (const int order : {2, 4, 8})
    for (const double f_hz : {3.0, 5.0, 6.0, 7.0, 12.0}) {
      const ButterworthOptions options{.order = order, .cutoff_hz = 6.0, .zero_phase = false};
      const std::complex<double> expected = Response(DesignButterworth(kRate_hz, options), f_hz);
      EXPECT_NEAR(std::abs(MeasuredResponse(f_hz, options) - expected), 0.0, 1e-9);
    }
}

TEST(Butterworth, OnePassIsAtMinus3DecibelsAtTheCutoffAndLagsByAnEighthOfATurnForEachOrder) {
  for (const int order : {2, 4, 8}) {
    const std::complex<double> response =
        MeasuredResponse(6.0, {.order = order, .cutoff_hz = 6.0, .zero_phase = false});
    EXPECT_NEAR(std::abs(response - std::polar(std::sqrt(0.5), -order * pi / 4.0)), 0.0, 1e-9);
  }
}

TEST(Butterworth, TwoPassesSquareTheMagnitudeAndHaveNoPhase) {
  for (const int order : {2, 4, 8})
    for (const double f_hz : {3.0, 5.0, 6.0, 7.0, 12.0}) {
      const std::complex<double> response =
          MeasuredResponse(f_hz, {.order = order, .cutoff_hz = 6.0, .correct_cutoff = false});
      EXPECT_NEAR(response.real(), std::pow(Magnitude(f_hz, order, 6.0), 2.0), 1e-9);
      EXPECT_NEAR(response.imag(), 0.0, 1e-9);
    }
}

TEST(Butterworth, WithWintersCorrectionTwoPassesAreAtMinus3DecibelsAtTheCutoff) {
  for (const int order : {2, 4, 8})
    for (const double cutoff_hz : {2.0, 6.0, 40.0}) {
      const std::complex<double> response =
          MeasuredResponse(cutoff_hz, {.order = order, .cutoff_hz = cutoff_hz});
      EXPECT_NEAR(response.real(), std::sqrt(0.5), 1e-9);
      EXPECT_NEAR(response.imag(), 0.0, 1e-9);
    }
}

// import numpy as np; from scipy.signal import *  # SciPy 1.10.1
// t = np.arange(20); x = np.sin(.3*t) + .5*np.cos(1.7*t) + .01*t**2; s = butter(4, 6, fs=30,
// output='sos') f = 30/np.pi*np.arctan(np.tan(np.pi*6/30)/(2**.5-1)**.25) print(sosfilt(s, x,
// zi=sosfilt_zi(s)*x[0])[0].tolist()) print(sosfiltfilt(s, x).tolist(), sosfiltfilt(butter(2, f,
// fs=30, output='sos'), x).tolist())
TEST(Butterworth, ShortCurvesComeOutAsInSciPy) {
  Eigen::RowVectorXd causal(20), both_ways(20), corrected(20);
  causal << 0.5, 0.48793959042003615, 0.42468238885922216, 0.3325527859774391, 0.41655405442773796,
      0.8218459465239113, 1.2596415797795482, 1.3542447873020627, 1.259251285086452,
      1.3125502987576143, 1.381572411284247, 1.2279965764434353, 1.0566741142358942,
      1.0710898441738181, 1.0687988913717863, 0.9704250566858482, 1.0600883310732923,
      1.3862314189887934, 1.6805439714065433, 1.980738616973726;
  both_ways << 0.499551293634407, 0.31846487801307055, 0.441607352774548, 0.8133174978098581,
      1.1433088888402394, 1.2867100446074622, 1.32593772852766, 1.3413076757856235,
      1.3124896747314692, 1.2345588264775031, 1.1473205657463033, 1.0591076663424506,
      0.981812383507819, 0.9903401490974476, 1.1232208125628427, 1.3090725617827872,
      1.5120972363957756, 1.8579198562740342, 2.4945763736392688, 3.376522164558344;
  corrected << 0.500016960151328, 0.2167410590622303, 0.3957024911055581, 0.9308299042967131,
      1.2283426311607795, 1.1613898981375597, 1.2288250855375344, 1.4645860566658129,
      1.3884321979863938, 1.1058464920111986, 1.1016805304904846, 1.1939656549420976,
      1.0004771552793477, 0.859328001044392, 1.1234765811790337, 1.414455582530449,
      1.4979045263271344, 1.805379383635546, 2.528604548041982, 3.3762258484274597;
  const Eigen::MatrixXd x = SampleCurve(20);
  EXPECT_TRUE(
      MatrixNear(ButterworthLowPass(x, 30.0, {.order = 4, .zero_phase = false}), causal, 1e-12));
  EXPECT_TRUE(MatrixNear(ButterworthLowPass(x, 30.0, {.order = 4, .correct_cutoff = false}),
                         both_ways, 1e-12));
  EXPECT_TRUE(MatrixNear(ButterworthLowPass(x, 30.0), corrected, 1e-12));
}

TEST(Butterworth, TheCausalPassDoesNotLookAhead) {
  Eigen::MatrixXd later = SampleCurve(30);
  later.rightCols(10).setConstant(100.0);
  const ButterworthOptions options{.order = 4, .zero_phase = false};
  EXPECT_TRUE(SameCurves(ButterworthLowPass(later, 30.0, options).leftCols(20),
                         ButterworthLowPass(SampleCurve(30), 30.0, options).leftCols(20)));
}

TEST(Butterworth, AConstantStaysWhateverTheNumberOfFrames) {
  for (const bool zero_phase : {false, true})
    for (const Eigen::Index num_frames : {0, 1, 2, 5, 6, 7, 200}) {
      const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(2, num_frames, -1.5);
      EXPECT_TRUE(
          MatrixNear(ButterworthLowPass(constant, kRate_hz, {.order = 6, .zero_phase = zero_phase}),
                     constant, 1e-9));
    }
}

TEST(Butterworth, TwoFramesAreFilteredToo) {
  const Eigen::RowVector2d x(0.0, 1.0);
  for (const bool zero_phase : {false, true}) {
    const Eigen::MatrixXd y = ButterworthLowPass(x, kRate_hz, {.zero_phase = zero_phase});
    EXPECT_TRUE(y.allFinite());
    EXPECT_LT(std::abs(y(0, 1) - y(0, 0)), 1.0);
  }
}

TEST(Butterworth, GapsStayAndDoNotSpread) {
  const Eigen::MatrixXd x = SampleCurve(60);
  Eigen::MatrixXd gappy(2, 60);
  gappy << x, Eigen::MatrixXd::Constant(1, 60, kNaN);
  gappy.middleCols(25, 4).setConstant(kNaN);
  for (const bool zero_phase : {false, true}) {
    const ButterworthOptions options{.zero_phase = zero_phase};
    Eigen::MatrixXd expected = gappy;
    expected.row(0).head(25) = ButterworthLowPass(x.leftCols(25), 30.0, options);
    expected.row(0).tail(31) = ButterworthLowPass(x.rightCols(31), 30.0, options);
    EXPECT_TRUE(SameCurves(ButterworthLowPass(gappy, 30.0, options), expected));
  }
}

TEST(Butterworth, BadOptionsAndRatesAreRefused) {
  EXPECT_EQ(ButterworthOptions().Validate(), "");
  const Eigen::MatrixXd x = SampleCurve(20);
  for (const int order : {-2, 0, 1, 3}) {
    EXPECT_NE(ButterworthOptions{.order = order}.Validate(), "");
    EXPECT_THROW(ButterworthLowPass(x, 30.0, {.order = order}), InputError);
  }
  for (const double cutoff_hz : {0.0, -6.0, kNaN, kInfinity}) {
    EXPECT_NE(ButterworthOptions{.cutoff_hz = cutoff_hz}.Validate(), "");
    EXPECT_THROW(ButterworthLowPass(x, 30.0, {.cutoff_hz = cutoff_hz}), InputError);
  }
  EXPECT_THROW(ButterworthLowPass(x, 30.0, {.cutoff_hz = 15.0}), InputError);
  EXPECT_NO_THROW(ButterworthLowPass(x, 30.0, {.cutoff_hz = 14.9}));
  EXPECT_THROW(ButterworthLowPass(x, 0.0), InputError);
  EXPECT_THROW(ButterworthLowPass(Eigen::RowVector3d(1.0, kInfinity, 0.0), 30.0), InputError);
}

}  // namespace
}  // namespace poselift
