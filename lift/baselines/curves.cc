// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/curves.h"

#include <fmt/format.h>

#include <cmath>

#include "src/input_error.h"

namespace poselift {

void RequireCurves(const Eigen::MatrixXd& curves) {
  for (Eigen::Index t = 0; t < curves.cols(); ++t)
    for (Eigen::Index c = 0; c < curves.rows(); ++c)
      if (std::isinf(curves(c, t)))
        throw InputError(fmt::format(
            "curves: channel {}, frame {} is infinite, wanted a number or NaN for a gap", c, t));
}

void RequireFrameRate(double frame_rate_hz) {
  if (!(frame_rate_hz > 0.0) || std::isinf(frame_rate_hz))
    throw InputError(fmt::format("frame rate {} Hz, wanted a positive number", frame_rate_hz));
}

Eigen::MatrixXd SmoothRuns(const Eigen::MatrixXd& curves,
                           const std::function<void(Eigen::VectorXd*)>& smooth) {
  RequireCurves(curves);
  Eigen::MatrixXd smoothed = curves;
  Eigen::VectorXd run;
  for (Eigen::Index c = 0; c < curves.rows(); ++c)
    for (Eigen::Index start = 0; start < curves.cols();) {
      Eigen::Index end = start;
      while (end < curves.cols() && !std::isnan(curves(c, end))) ++end;
      if (end > start) {
        run = curves.row(c).segment(start, end - start);
        smooth(&run);
        smoothed.row(c).segment(start, end - start) = run;
      }
      start = end + 1;
    }
  return smoothed;
}

}  // namespace poselift
