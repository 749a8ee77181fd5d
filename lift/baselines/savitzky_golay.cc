// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/savitzky_golay.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>

#include "src/input_error.h"

namespace poselift {
namespace {

// V (V^T V)^-1 V^T, window x window, as Q Q^T of V = Q R. The powers are taken
// of -1..1, which changes R alone and keeps it well conditioned.
Eigen::MatrixXd Projector(Eigen::Index window, Eigen::Index degree) {
  const Eigen::ArrayXd frames = Eigen::ArrayXd::LinSpaced(window, -1.0, 1.0);
  Eigen::MatrixXd V = Eigen::MatrixXd::Ones(window, degree + 1);
  for (Eigen::Index d = 1; d <= degree; ++d) V.col(d) = V.col(d - 1).array() * frames;
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(V).householderQ() *
                            Eigen::MatrixXd::Identity(window, degree + 1);
  return Q * Q.transpose();
}

Eigen::VectorXd Smooth(const Eigen::MatrixXd& projector, const Eigen::VectorXd& curve) {
  const Eigen::Index window = projector.rows();
  Eigen::VectorXd smoothed(curve.size());
  for (Eigen::Index t = 0; t < curve.size(); ++t) {
    const Eigen::Index start = std::clamp<Eigen::Index>(t - window / 2, 0, curve.size() - window);
    smoothed[t] = projector.col(t - start).dot(curve.segment(start, window));
  }
  return smoothed;
}

}  // namespace

std::string SavitzkyGolayOptions::Validate() const {
  if (window_frames < 1 || window_frames % 2 == 0)
    return fmt::format("SavitzkyGolayOptions::window_frames = {}, wanted an odd number from 1 on",
                       window_frames);
  if (degree < 0 || degree >= window_frames)
    return fmt::format("SavitzkyGolayOptions::degree = {}, wanted 0 to {}, less than the window",
                       degree, window_frames - 1);
  return "";
}

Eigen::MatrixXd SavitzkyGolay(const Eigen::MatrixXd& curves, const SavitzkyGolayOptions& options) {
  if (const std::string wrong = options.Validate(); !wrong.empty()) throw InputError(wrong);
  Eigen::MatrixXd projector;
  return SmoothRuns(curves, [&](Eigen::VectorXd* run) {
    const auto window = std::min<Eigen::Index>(options.window_frames, run->size());
    if (projector.rows() != window)
      projector = Projector(window, std::min<Eigen::Index>(options.degree, window - 1));
    *run = Smooth(projector, *run);
  });
}

}  // namespace poselift
