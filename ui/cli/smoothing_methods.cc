// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/smoothing_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "lift/baselines/butterworth.h"
#include "lift/default_dictionary.h"
#include "lift/model_smoother.h"
#include "lift/online_smoothing.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/body_map.h"

namespace poselift::cli {
namespace {

// Above a quarter of the frame rate a low-pass filter hardly filters.
constexpr double kUsualCutoff_hz = 6.0;
constexpr double kMostOfRate = 0.25;

Smoothing Butterworth(const Motion& motion, const SmoothingOptions& options) {
  ButterworthOptions filter;
  filter.cutoff_hz =
      options.cutoff_hz.value_or(std::min(kUsualCutoff_hz, kMostOfRate / motion.frame_time_s));
  return {SmootherOfCurves(GapFill::kNaturalSpline,
                           [filter](const Eigen::MatrixXd& curves, double frame_rate_hz) {
                             return ButterworthLowPass(curves, frame_rate_hz, filter);
                           }),
          fmt::format("Butterworth filter of fourth order, zero lag, cutoff {:.3g} Hz{}",
                      filter.cutoff_hz,
                      !options.cutoff_hz && filter.cutoff_hz < kUsualCutoff_hz
                          ? " (a quarter of the frame rate)"
                          : "")};
}

Smoothing SavitzkyGolayFilter(const Motion&, const SmoothingOptions& options) {
  const SavitzkyGolayOptions filter = options.savitzky_golay;
  return {SmootherOfCurves(GapFill::kNaturalSpline,
                           [filter](const Eigen::MatrixXd& curves, double) {
                             return SavitzkyGolay(curves, filter);
                           }),
          fmt::format("Savitzky-Golay filter, {} frames, degree {}", filter.window_frames,
                      filter.degree)};
}

Smoothing OneEuro(const Motion&, const SmoothingOptions& options) {
  const OneEuroOptions filter = options.one_euro;
  return {SmootherOfCurves(GapFill::kLinear,
                           [filter](const Eigen::MatrixXd& curves, double frame_rate_hz) {
                             return SmoothOneEuro(curves, frame_rate_hz, filter);
                           }),
          fmt::format("One Euro filter, from earlier frames alone (gaps but not), cutoff {:.3g} Hz "
                      "at rest, {:.3g} Hz more for each rad/s or m/s",
                      filter.min_cutoff_hz, filter.beta)};
}

Smoothing ByModel(const Motion& motion, const SmoothingOptions& options) {
  const auto codebook = ReadCodebook(options);
  return {SmootherByModel(codebook, Butterworth(motion, options).smoother),
          fmt::format("motion model of {} segments, from all frames", codebook->NumSegments())};
}

// The model where the skeleton is a body.
Smoothing Auto(const Motion& motion, const SmoothingOptions& options) {
  const std::string flaw = FindBody(motion.skeleton).flaw;
  if (flaw.empty()) return ByModel(motion, options);
  Smoothing smoothing = Butterworth(motion, options);
  smoothing.summary += "; no motion model: " + flaw;
  return smoothing;
}

// What a live stream would get, frame by frame.
Smoothing Online(const Motion& motion, const SmoothingOptions& options) {
  const auto codebook = ReadCodebook(options);
  return {SmootherOnline(codebook, OneEuro(motion, options).smoother, options.online),
          fmt::format("motion model of {} segments, from earlier frames and {:.3g} s of later ones",
                      codebook->NumSegments(), options.online.latency_s)};
}

Smoothing FillAlone(GapFill fill, std::string summary) {
  const auto as_it_is = [](const Eigen::MatrixXd& curves, double) { return curves; };
  return {SmootherOfCurves(fill, as_it_is), std::move(summary)};
}

constexpr std::array kMethods = {
    SmoothingMethod{"auto", "motion-model where the skeleton is a body's, else butterworth", Auto},
    SmoothingMethod{"motion-model",
                    "what similar motions do, on any skeleton of a body; the rest as "
                    "butterworth",
                    ByModel},
    SmoothingMethod{kOnlineMethod, "the same model on a stream, --latency-s late", Online},
    SmoothingMethod{"butterworth", "low-pass filter forward and backward", Butterworth},
    SmoothingMethod{"savitzky-golay", "local polynomials", SavitzkyGolayFilter},
    SmoothingMethod{"one-euro", "online, lags little when fast", OneEuro},
    SmoothingMethod{"linear", "fills gaps with straight lines, changes nothing else",
                    [](const Motion&, const SmoothingOptions&) {
                      return FillAlone(GapFill::kLinear, "gaps filled with straight lines alone");
                    }},
    SmoothingMethod{"spline", "fills gaps with a natural spline, changes nothing else",
                    [](const Motion&, const SmoothingOptions&) {
                      return FillAlone(GapFill::kNaturalSpline,
                                       "gaps filled with a natural spline alone");
                    }},
};

}  // namespace

std::shared_ptr<const MotionCodebook> ReadCodebook(const SmoothingOptions& options) {
  return std::make_shared<MotionCodebook>(WithMirrored(ReadMotionCodebook(
      options.motion_model.empty() ? DefaultMotionModelPath()
                                   : std::filesystem::path(options.motion_model))));
}

std::span<const SmoothingMethod> SmoothingMethods() { return kMethods; }

}  // namespace poselift::cli
