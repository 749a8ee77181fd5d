// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/one_euro.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "src/input_error.h"

namespace poselift {
namespace {

std::string WrongUnlessPositive(const char* name, double value) {
  if (value > 0.0 && std::isfinite(value)) return "";
  return fmt::format("OneEuroOptions::{} = {}, wanted a positive number", name, value);
}

double Alpha(double cutoff_hz, double elapsed_s) {
  return 1.0 / (1.0 + 1.0 / (2.0 * std::numbers::pi * cutoff_hz * elapsed_s));
}

}  // namespace

std::string OneEuroOptions::Validate() const {
  if (std::string wrong = WrongUnlessPositive("min_cutoff_hz", min_cutoff_hz); !wrong.empty())
    return wrong;
  if (!(beta >= 0.0) || std::isinf(beta))
    return fmt::format("OneEuroOptions::beta = {}, wanted a number from 0 on", beta);
  return WrongUnlessPositive("derivative_cutoff_hz", derivative_cutoff_hz);
}

OneEuroFilter::OneEuroFilter(double frame_rate_hz, const OneEuroOptions& options)
    : frame_time_s_(1.0 / frame_rate_hz), options_(options) {
  RequireFrameRate(frame_rate_hz);
  if (const std::string wrong = options.Validate(); !wrong.empty()) throw InputError(wrong);
}

const Eigen::VectorXd& OneEuroFilter::Step(const Eigen::Ref<const Eigen::VectorXd>& frame) {
  if (channels_.empty()) channels_.resize(static_cast<size_t>(frame.size()));
  const auto num_channels = static_cast<Eigen::Index>(channels_.size());
  if (frame.size() != num_channels)
    throw InputError(fmt::format("One Euro filter: a frame of {} channels, wanted {} as before",
                                 frame.size(), num_channels));
  for (Eigen::Index c = 0; c < num_channels; ++c)
    if (std::isinf(frame[c]))
      throw InputError(fmt::format(
          "One Euro filter: channel {} is infinite, wanted a number or NaN for a gap", c));
  smoothed_.resize(num_channels);
  for (Eigen::Index c = 0; c < num_channels; ++c)
    smoothed_[c] = StepChannel(frame[c], &channels_[static_cast<size_t>(c)]);
  return smoothed_;
}

double OneEuroFilter::StepChannel(double x, Channel* channel) const {
  const bool is_first = channel->wait_s < 0.0;
  if (!is_first) channel->wait_s += frame_time_s_;
  if (std::isnan(x)) return x;
  if (is_first) {
    channel->smoothed = x;
  } else {
    const double elapsed_s = channel->wait_s;
    const double change = x - channel->smoothed;
    channel->slope +=
        Alpha(options_.derivative_cutoff_hz, elapsed_s) * (change / elapsed_s - channel->slope);
    const double cutoff_hz = options_.min_cutoff_hz + options_.beta * std::abs(channel->slope);
    channel->smoothed += Alpha(cutoff_hz, elapsed_s) * change;
  }
  channel->wait_s = 0.0;
  return channel->smoothed;
}

Eigen::MatrixXd SmoothOneEuro(const Eigen::MatrixXd& curves, double frame_rate_hz,
                              const OneEuroOptions& options) {
  RequireCurves(curves);
  OneEuroFilter filter(frame_rate_hz, options);
  Eigen::MatrixXd smoothed(curves.rows(), curves.cols());
  for (Eigen::Index t = 0; t < curves.cols(); ++t) smoothed.col(t) = filter.Step(curves.col(t));
  return smoothed;
}

}  // namespace poselift
