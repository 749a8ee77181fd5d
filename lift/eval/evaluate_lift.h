// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lift/eval/synthetic_view.h"
#include "src/observation.h"
#include "src/pose3.h"
#include "src/progress.h"

namespace poselift {

// How far lifted poses are from the truth: known poses are seen by random
// cameras, their labels go to every method, and the methods' answers are
// compared with the poses. All methods get the same labels.

struct LiftMethod {
  std::string name;
  // Joints in cam; nothing when the method gives up.
  std::function<std::optional<Pose3>(const Observation&)> lift;
  // Somebody who knows the truth looks at the answer and gives a hint, up to so many times
  // (HintOfWorstLimb); each time it lifts again.
  int max_hints = 0;
};

// What somebody who sees the true pose says of a lifted one: of the upper arms, forearms,
// thighs and shanks that go the wrong way in depth, by at least kLeastFlip_m in truth,
// which way the deepest goes. Nothing when all are right.
std::optional<LabelHint> HintOfWorstLimb(const Pose3& lifted_in_cam_m, const Pose3& truth_in_cam_m);

struct LiftEvaluation {
  std::string method;
  std::string views;
  double noise_mm = 0.0;
  int num_poses = 0;
  int num_failed = 0;      // not in the errors
  double num_hints = 0.0;  // given, mean of the poses
  int num_hinted = 0;      // poses that were given any
  double pa_mm = 0.0, pa_standard_error_mm = 0.0, pa_median_mm = 0.0;
  double cam_mm = 0.0, cam_standard_error_mm = 0.0, cam_median_mm = 0.0;
  double ms_per_lift = 0.0;  // of one thread's time
};

struct EvaluateLiftOptions {
  std::string layout = "body15";
  std::vector<ViewRange> views = {kLevelViews, kFreeViews};
  std::vector<double> noises_m = {0.0, 0.020};
  int num_poses = 2000;
  std::uint64_t seed = 1;
};

// test_poses_m: 69 x m, body frame; num_poses columns are drawn.
std::vector<LiftEvaluation> EvaluateLift(const std::vector<LiftMethod>& methods,
                                         const Eigen::MatrixXd& test_poses_m,
                                         const EvaluateLiftOptions& options,
                                         const ProgressFn& progress);

}  // namespace poselift
