// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/eval/sequence_error.h"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace poselift {
namespace {

void RequireFrames(const std::vector<Pose3>& estimate, const std::vector<Pose3>& truth,
                   size_t fewest) {
  if (estimate.size() != truth.size() || truth.size() < fewest)
    throw std::invalid_argument("sequence error: too few frames, or not as many as the truth has");
}

// Where the parabola through (-1, before), (0, least), (1, after) is least.
double ParabolaMinimum(double before, double least, double after) {
  const double curvature = before - 2.0 * least + after;
  return curvature > 0.0 ? 0.5 * (before - after) / curvature : 0.0;
}

}  // namespace

double Jitter_mm(const std::vector<Pose3>& estimate, const std::vector<Pose3>& truth) {
  RequireFrames(estimate, truth, 3);
  double sum_m = 0.0;
  for (size_t t = 1; t + 1 < truth.size(); ++t)
    sum_m += ((estimate[t + 1] - 2.0 * estimate[t] + estimate[t - 1]) -
              (truth[t + 1] - 2.0 * truth[t] + truth[t - 1]))
                 .colwise()
                 .norm()
                 .mean();
  return 1e3 * sum_m / static_cast<double>(truth.size() - 2);
}

double Lag_frames(const std::vector<Pose3>& estimate, const std::vector<Pose3>& truth) {
  RequireFrames(estimate, truth, kFewestLagFrames);
  std::array<double, 2 * kMostLag_frames + 1> costs{};  // of the lags -5 ... 5
  const int end = static_cast<int>(truth.size()) - 1 - kMostLag_frames;
  for (int lag = -kMostLag_frames; lag <= kMostLag_frames; ++lag)
    for (int t = kMostLag_frames; t < end; ++t)
      costs[lag + kMostLag_frames] +=
          ((estimate[t + 1] - estimate[t]) - (truth[t - lag + 1] - truth[t - lag])).squaredNorm();
  int least = 0;  // the nearest to 0 of equals
  for (int lag = -kMostLag_frames; lag <= kMostLag_frames; ++lag) {
    const double cost = costs[lag + kMostLag_frames], best = costs[least + kMostLag_frames];
    if (cost < best || (cost == best && std::abs(lag) < std::abs(least))) least = lag;
  }
  if (std::abs(least) == kMostLag_frames) return least;
  const double* cost = costs.data() + kMostLag_frames + least;
  return least + ParabolaMinimum(cost[-1], cost[0], cost[1]);
}

}  // namespace poselift
