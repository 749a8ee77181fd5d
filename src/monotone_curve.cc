// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/monotone_curve.h"

#include <algorithm>
#include <utility>

namespace poselift {

MonotoneCurve::MonotoneCurve(std::vector<double> times, Eigen::MatrixXd values)
    : times_(std::move(times)),
      values_(std::move(values)),
      slopes_(Eigen::MatrixXd::Zero(values_.rows(), values_.cols())) {
  for (Eigen::Index i = 1; i + 1 < values_.cols(); ++i) {
    const auto at = static_cast<size_t>(i);
    const double before = times_[at] - times_[at - 1], behind = times_[at + 1] - times_[at];
    const double w_before = before + 2.0 * behind, w_behind = 2.0 * before + behind;
    for (Eigen::Index row = 0; row < values_.rows(); ++row) {
      const double d_before = (values_(row, i) - values_(row, i - 1)) / before;
      const double d_behind = (values_(row, i + 1) - values_(row, i)) / behind;
      if (d_before * d_behind > 0.0)
        slopes_(row, i) = (w_before + w_behind) / (w_before / d_before + w_behind / d_behind);
    }
  }
}

Eigen::VectorXd MonotoneCurve::At(double time) const {
  const auto behind = std::ranges::upper_bound(times_, time) - times_.begin();
  if (behind == 0) return values_.col(0);
  if (behind == values_.cols()) return values_.col(behind - 1);
  const auto at = static_cast<size_t>(behind);
  const double step = times_[at] - times_[at - 1], t = (time - times_[at - 1]) / step;
  const double part = t * t * (3.0 - 2.0 * t);
  return (1.0 - part) * values_.col(behind - 1) + part * values_.col(behind) +
         step * t * (1.0 - t) * ((1.0 - t) * slopes_.col(behind - 1) - t * slopes_.col(behind));
}

}  // namespace poselift
