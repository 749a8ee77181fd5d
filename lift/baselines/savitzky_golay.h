// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>

#include "lift/baselines/curves.h"

namespace poselift {

// Local polynomials: every frame gets the value at that frame of the polynomial
// that fits the window around it best,
//
//   x^(t) = p(t),   p = argmin over degree <= d of  sum_s (p(s) - x(s))^2
//
// (A. Savitzky, M. J. E. Golay, Analytical Chemistry 36, 1964). With V the
// powers of the window's frames, p at those frames is V (V^T V)^-1 V^T x: a
// fixed matrix, of which an inner frame takes the middle row. The first and last
// half window have no window of their own and take the other rows: the values of
// the polynomial of the first or last window, as in scipy.signal.savgol_filter
// with mode='interp'. Polynomials up to the degree come out as they went in.
struct SavitzkyGolayOptions {
  int window_frames = 9;  // odd
  int degree = 3;         // less than the window; = window - 1 smooths nothing

  std::string Validate() const;  // empty, or which option is wrong and why
};

// Smooths each channel; curves as in curves.h, of any frame rate. Gaps stay, and
// what is between them is smoothed on its own. Fewer frames than a window are
// one window, with a degree below their number.
//
// Throws InputError when the options are invalid or an entry is infinite.
Eigen::MatrixXd SavitzkyGolay(const Eigen::MatrixXd& curves,
                              const SavitzkyGolayOptions& options = {});

}  // namespace poselift
