// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace poselift::testing {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One channel, slow and fast: the curve of the numbers that come from SciPy.
inline Eigen::RowVectorXd SampleCurve(Eigen::Index num_frames) {
  const Eigen::ArrayXd t =
      Eigen::ArrayXd::LinSpaced(num_frames, 0.0, static_cast<double>(num_frames - 1));
  return ((0.3 * t).sin() + 0.5 * (1.7 * t).cos() + 0.01 * t.square()).matrix().transpose();
}

// Bit for bit, NaN equal to NaN.
inline ::testing::AssertionResult SameCurves(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() == b.rows() && a.cols() == b.cols() &&
      ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all())
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\n" << a << "\nand\n" << b;
}

}  // namespace poselift::testing
