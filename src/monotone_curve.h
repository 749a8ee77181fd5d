// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

namespace poselift {

// Smooth curves (C1) through values at growing times that nowhere leave the range of the two
// values around: what rests stays at rest, and limits that the values keep the curve keeps.
//
// Cubic Hermite pieces. The slope at a value is 0 where the curve turns, rests, begins or ends;
// elsewhere, between steps of the slopes d and the lengths h (Fritsch and Butland 1984),
//   m = (w_1 + w_2) / (w_1 / d_1 + w_2 / d_2),   w_1 = h_1 + 2 h_2,   w_2 = 2 h_1 + h_2
class MonotoneCurve {
 public:
  // values: a row for each curve, a column for each time. At least one time.
  MonotoneCurve(std::vector<double> times, Eigen::MatrixXd values);

  Eigen::VectorXd At(double time) const;  // before and behind all times as there

 private:
  std::vector<double> times_;
  Eigen::MatrixXd values_, slopes_;
};

}  // namespace poselift
