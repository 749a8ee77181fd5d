// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift/baselines/curves.h"

namespace poselift {

// The low-pass filter of biomechanics. One pass of order N has the magnitude
//
//   |H(f)|^2 = 1 / (1 + (W(f) / W_c)^2N),   W(f) = tan(pi f / frame rate)
//
// which is Butterworth's analogue filter (1930) under the bilinear transform
// s = (1 - z^-1) / (1 + z^-1), the cutoff pre-warped: W_c = W(cutoff).
struct ButterworthOptions {
  // Of one pass, even. Two passes of order 2 are what biomechanics calls the
  // zero-lag filter of fourth order.
  int order = 2;
  double cutoff_hz = 6.0;  // less than half of the frame rate
  // Once forward and once backward: the phase is 0 and the magnitude |H|^2.
  // Else forward only, which is causal and lags.
  bool zero_phase = true;
  // Two passes are at -6 dB at the cutoff of each. With the correction each has
  //   W_c = W(cutoff) / (sqrt(2) - 1)^(1/2N)
  // and both together are at -3 dB at cutoff_hz (D. A. Winter, Biomechanics and
  // Motor Control of Human Movement, 4th ed. 2009, section 3.4.4.2). It does
  // nothing to a single pass.
  bool correct_cutoff = true;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// H(z) = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2), with H(1) = 1.
struct SecondOrderSection {
  double b0, b1, b2;
  double a1, a2;
};

// One pass: order / 2 sections in a row, a pair of conjugate poles each. Throws
// InputError when the options are invalid or the frame rate is not more than
// twice the cutoff.
std::vector<SecondOrderSection> DesignButterworth(double frame_rate_hz,
                                                  const ButterworthOptions& options);

// Filters each channel; curves as in curves.h. Every pass starts in the steady
// state of its first value, so a constant stays what it is. In the double pass
// each end is first continued by 3 (order + 1) frames, or one less than there
// are, reflected in its end point (2 x_0 - x_i): what scipy.signal.sosfiltfilt
// does, which refuses curves too short for the padding. Gaps stay, and what is
// between them is filtered on its own.
//
// Throws InputError as DesignButterworth does, or when an entry is infinite.
Eigen::MatrixXd ButterworthLowPass(const Eigen::MatrixXd& curves, double frame_rate_hz,
                                   const ButterworthOptions& options = {});

}  // namespace poselift
