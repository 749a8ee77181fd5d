// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/butterworth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/input_error.h"

namespace poselift {
namespace {

// One pass, in place, by the transposed direct form II. Each section starts as
// if the first value had been there for ever: its output is then that value too.
void FilterForward(const std::vector<SecondOrderSection>& sections, Eigen::VectorXd* curve) {
  for (const SecondOrderSection& s : sections) {
    const double rest = (*curve)[0];
    double state1 = (1.0 - s.b0) * rest;
    double state2 = (s.b2 - s.a2) * rest;
    for (double& x : *curve) {
      const double y = s.b0 * x + state1;
      state1 = s.b1 * x - s.a1 * y + state2;
      state2 = s.b2 * x - s.a2 * y;
      x = y;
    }
  }
}

// The curve with `count` frames before and behind, turned about its end points.
Eigen::VectorXd ReflectEnds(const Eigen::VectorXd& curve, Eigen::Index count) {
  const Eigen::Index last = curve.size() - 1;
  Eigen::VectorXd padded(curve.size() + 2 * count);
  padded.head(count) = 2.0 * curve[0] - curve.segment(1, count).reverse().array();
  padded.segment(count, curve.size()) = curve;
  padded.tail(count) = 2.0 * curve[last] - curve.segment(last - count, count).reverse().array();
  return padded;
}

void FilterBothWays(const std::vector<SecondOrderSection>& sections, Eigen::VectorXd* curve) {
  const auto num_sections = static_cast<Eigen::Index>(sections.size());
  const Eigen::Index padding = std::min(3 * (2 * num_sections + 1), curve->size() - 1);
  Eigen::VectorXd padded = ReflectEnds(*curve, padding);
  FilterForward(sections, &padded);
  padded.reverseInPlace();
  FilterForward(sections, &padded);
  padded.reverseInPlace();
  *curve = padded.segment(padding, curve->size());
}

}  // namespace

std::string ButterworthOptions::Validate() const {
  if (order < 2 || order % 2 != 0)
    return fmt::format("ButterworthOptions::order = {}, wanted an even number from 2 on", order);
  if (!(cutoff_hz > 0.0) || std::isinf(cutoff_hz))
    return fmt::format("ButterworthOptions::cutoff_hz = {}, wanted a positive number", cutoff_hz);
  return "";
}

std::vector<SecondOrderSection> DesignButterworth(double frame_rate_hz,
                                                  const ButterworthOptions& options) {
  RequireFrameRate(frame_rate_hz);
  if (const std::string wrong = options.Validate(); !wrong.empty()) throw InputError(wrong);
  if (!(2.0 * options.cutoff_hz < frame_rate_hz))
    throw InputError(fmt::format(
        "ButterworthOptions::cutoff_hz = {}, wanted less than half of the frame rate of {} Hz",
        options.cutoff_hz, frame_rate_hz));
  using std::numbers::pi;
  double cutoff = std::tan(pi * options.cutoff_hz / frame_rate_hz);
  if (options.zero_phase && options.correct_cutoff)
    cutoff /= std::pow(std::numbers::sqrt2 - 1.0, 0.5 / options.order);
  // The poles lie evenly on the left half of a circle. A pair gives
  // W_c^2 / (s^2 + 2 sin(angle) W_c s + W_c^2), from which the transform makes:
  std::vector<SecondOrderSection> sections;
  for (int k = 0; k < options.order / 2; ++k) {
    const double damping = 2.0 * std::sin(pi * (2 * k + 1) / (2.0 * options.order)) * cutoff;
    const double squared = cutoff * cutoff;
    const double a0 = 1.0 + damping + squared;
    sections.push_back({.b0 = squared / a0,
                        .b1 = 2.0 * squared / a0,
                        .b2 = squared / a0,
                        .a1 = 2.0 * (squared - 1.0) / a0,
                        .a2 = (1.0 - damping + squared) / a0});
  }
  return sections;
}

Eigen::MatrixXd ButterworthLowPass(const Eigen::MatrixXd& curves, double frame_rate_hz,
                                   const ButterworthOptions& options) {
  const std::vector<SecondOrderSection> sections = DesignButterworth(frame_rate_hz, options);
  return SmoothRuns(curves, [&](Eigen::VectorXd* run) {
    if (options.zero_phase)
      FilterBothWays(sections, run);
    else
      FilterForward(sections, run);
  });
}

}  // namespace poselift
