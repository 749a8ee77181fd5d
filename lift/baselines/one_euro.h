// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift/baselines/curves.h"

namespace poselift {

// The 1 Euro filter: a low-pass filter of first order whose cutoff rises with
// speed, so that a still body does not jitter and a fast one lags little
// (G. Casiez, N. Roussel, D. Vogel, CHI 2012). For each channel, with the time
// dt since its value before and alpha(f) = 1 / (1 + 1 / (2 pi f dt)):
//
//   dx  = (x - x^_before) / dt
//   dx^ = dx^_before + alpha(derivative_cutoff) (dx - dx^_before)
//   x^  = x^_before + alpha(min_cutoff + beta |dx^|) (x - x^_before)
//
// The first value is x^ itself, its dx^ is 0. beta = 0 is the exponential filter.
struct OneEuroOptions {
  double min_cutoff_hz = 1.0;  // lower: less jitter at rest
  // Hz for each rad/s or m/s, higher: less lag at speed. The paper's way to set
  // it: at rest lower min_cutoff_hz until jitter is gone, then moving fast raise
  // beta until lag is.
  double beta = 3.0;
  double derivative_cutoff_hz = 1.0;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// Online: frame after frame, as they are captured.
class OneEuroFilter {
 public:
  // Throws InputError when the options are invalid or the rate is not positive.
  explicit OneEuroFilter(double frame_rate_hz, const OneEuroOptions& options = {});

  // One number a channel, NaN where it is missing; the first frame says how
  // many. What is missing stays so, and makes dt longer for the next value. The
  // result stands until the next call. Throws InputError when the number of
  // channels changes or an entry is infinite.
  const Eigen::VectorXd& Step(const Eigen::Ref<const Eigen::VectorXd>& frame);

  // Forgets all frames.
  void Reset() { channels_.clear(); }

 private:
  struct Channel {
    double smoothed = 0.0;
    double slope = 0.0;    // per second
    double wait_s = -1.0;  // since the last value; negative before the first
  };

  double StepChannel(double x, Channel* channel) const;

  double frame_time_s_;
  OneEuroOptions options_;
  std::vector<Channel> channels_;
  Eigen::VectorXd smoothed_;
};

// A whole matrix, as in curves.h, from the first frame on: what Step returns.
Eigen::MatrixXd SmoothOneEuro(const Eigen::MatrixXd& curves, double frame_rate_hz,
                              const OneEuroOptions& options = {});

}  // namespace poselift
