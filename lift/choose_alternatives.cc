// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/choose_alternatives.h"

#include <algorithm>
#include <limits>

namespace poselift {
namespace {

// The best way to each alternative of a frame.
struct Step {
  size_t frame;
  std::vector<double> costs;
  std::vector<int> from;  // alternatives of the step before
};

Step StepTo(const std::vector<LiftResult>& frames, size_t frame, const Step& before,
            double per_m2) {
  Step step{frame, {}, {}};
  for (const LiftedPose& pose : frames[frame].poses) {
    double least = std::numeric_limits<double>::infinity();
    int from = 0;
    for (size_t i = 0; i < before.costs.size(); ++i) {
      const Pose3& joints_before_m = frames[before.frame].poses[i].joints_in_cam_m;
      const double cost =
          before.costs[i] + per_m2 * (pose.joints_in_cam_m - joints_before_m).squaredNorm();
      if (cost >= least) continue;
      least = cost;
      from = static_cast<int>(i);
    }
    step.costs.push_back(pose.cost + least);
    step.from.push_back(from);
  }
  return step;
}

}  // namespace

std::vector<int> ChooseAlternatives(const std::vector<LiftResult>& frames, double frame_time_s,
                                    double drift_m2_per_s) {
  std::vector<Step> steps;
  for (size_t t = 0; t < frames.size(); ++t) {
    if (frames[t].poses.empty()) continue;
    if (steps.empty()) {
      steps.push_back({t, {}, {}});
      for (const LiftedPose& pose : frames[t].poses) steps.back().costs.push_back(pose.cost);
      continue;
    }
    const double elapsed_s = static_cast<double>(t - steps.back().frame) * frame_time_s;
    steps.push_back(StepTo(frames, t, steps.back(), 1.0 / (drift_m2_per_s * elapsed_s)));
  }
  std::vector<int> chosen(frames.size(), -1);
  if (steps.empty()) return chosen;
  const std::vector<double>& last = steps.back().costs;
  int best = static_cast<int>(std::min_element(last.begin(), last.end()) - last.begin());
  for (size_t i = steps.size(); i-- > 0;) {
    chosen[steps[i].frame] = best;
    if (i > 0) best = steps[i].from[static_cast<size_t>(best)];
  }
  return chosen;
}

}  // namespace poselift
