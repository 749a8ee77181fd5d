// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/eval/evaluate_lift.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "lift/depth_mirror.h"
#include "lift/eval/pose_error.h"

namespace poselift {
namespace {

struct Case {
  Pose3 truth_in_cam_m;
  Observation observation;
};

std::vector<Case> MakeCases(const Eigen::MatrixXd& test_poses_m, const Layout& layout,
                            const ViewRange& views, double noise_m,
                            const EvaluateLiftOptions& options) {
  // The same poses and cameras whatever the noise.
  std::mt19937_64 rng(options.seed);
  std::vector<Case> cases;
  for (int i = 0; i < options.num_poses; ++i) {
    std::uniform_int_distribution<Eigen::Index> draw(0, test_poses_m.cols() - 1);
    const Pose3 pose = Unstacked(test_poses_m.col(draw(rng)));
    std::mt19937_64 view_rng(rng());
    const SyntheticView view = MakeView(pose, layout, views, noise_m, &view_rng);
    cases.push_back({view.joints_in_cam_m, Observe(view.labels, layout)});
  }
  return cases;
}

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double StandardError(const std::vector<double>& values, double mean) {
  double squared = 0.0;
  for (const double value : values) squared += (value - mean) * (value - mean);
  const auto count = static_cast<double>(values.size());
  return std::sqrt(squared / (count * std::max(1.0, count - 1.0)));
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void Summarize(const std::vector<double>& pa_mm, const std::vector<double>& cam_mm,
               LiftEvaluation* evaluation) {
  if (pa_mm.empty()) return;
  evaluation->pa_mm = Mean(pa_mm);
  evaluation->pa_standard_error_mm = StandardError(pa_mm, evaluation->pa_mm);
  evaluation->pa_median_mm = Median(pa_mm);
  evaluation->cam_mm = Mean(cam_mm);
  evaluation->cam_standard_error_mm = StandardError(cam_mm, evaluation->cam_mm);
  evaluation->cam_median_mm = Median(cam_mm);
}

std::optional<Pose3> LiftWithHints(const LiftMethod& method, const Case& one, int* num_hints) {
  std::optional<Pose3> lifted = method.lift(one.observation);
  std::vector<LabelHint> hints;
  for (int i = 0; i < method.max_hints && lifted; ++i) {
    const auto hint = HintOfWorstLimb(*lifted, one.truth_in_cam_m);
    const bool is_said = hint && std::any_of(hints.begin(), hints.end(), [&](const LabelHint& h) {
                           return h.joint == hint->joint;
                         });
    if (!hint || is_said) break;
    hints.push_back(*hint);
    Observation hinted = one.observation;
    hinted.relations = RelationsOf(hints, *FindLayout("joints23"));
    lifted = method.lift(hinted);
  }
  *num_hints = static_cast<int>(hints.size());
  return lifted;
}

LiftEvaluation Evaluate(const LiftMethod& method, const std::vector<Case>& cases,
                        const std::function<void()>& advance) {
  using Clock = std::chrono::steady_clock;
  const auto count = static_cast<int>(cases.size());
  std::vector<double> pa_mm(cases.size()), cam_mm(cases.size()), seconds(cases.size());
  std::vector<int> num_hints(cases.size());
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < count; ++i) {
    const auto start = Clock::now();
    const std::optional<Pose3> lifted = LiftWithHints(method, cases[i], &num_hints[i]);
    seconds[i] = std::chrono::duration<double>(Clock::now() - start).count();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    pa_mm[i] = lifted ? PaError_mm(*lifted, cases[i].truth_in_cam_m) : nan;
    cam_mm[i] = lifted ? CamError_mm(*lifted, cases[i].truth_in_cam_m) : nan;
    advance();
  }
  const auto is_nan = [](double value) { return std::isnan(value); };
  std::erase_if(pa_mm, is_nan);
  std::erase_if(cam_mm, is_nan);
  LiftEvaluation evaluation{.method = method.name, .num_poses = count};
  evaluation.num_failed = count - static_cast<int>(pa_mm.size());
  evaluation.ms_per_lift = 1e3 * Mean(seconds);
  evaluation.num_hints = std::accumulate(num_hints.begin(), num_hints.end(), 0.0) / count;
  evaluation.num_hinted =
      count - static_cast<int>(std::count(num_hints.begin(), num_hints.end(), 0));
  Summarize(pa_mm, cam_mm, &evaluation);
  return evaluation;
}

}  // namespace

std::optional<LabelHint> HintOfWorstLimb(const Pose3& lifted_in_cam_m,
                                         const Pose3& truth_in_cam_m) {
  std::optional<LabelHint> worst;
  double deepest_m = kLeastFlip_m;
  for (const Limb limb : {Limb::kLeftLeg, Limb::kRightLeg, Limb::kLeftArm, Limb::kRightArm})
    for (const int end : JointsOfLimb(limb).subspan(1, 2)) {
      const int start = Joints()[static_cast<size_t>(end)].parent;
      const double truth_m = truth_in_cam_m(2, end) - truth_in_cam_m(2, start);
      const double lifted_m = lifted_in_cam_m(2, end) - lifted_in_cam_m(2, start);
      if (truth_m * lifted_m >= 0.0 || std::abs(truth_m) < deepest_m) continue;
      deepest_m = std::abs(truth_m);
      worst = LabelHint{
          truth_m < 0.0 ? LabelHint::Kind::kTowardsCamera : LabelHint::Kind::kAwayFromCamera,
          std::string(Joints()[static_cast<size_t>(end)].name)};
    }
  return worst;
}

std::vector<LiftEvaluation> EvaluateLift(const std::vector<LiftMethod>& methods,
                                         const Eigen::MatrixXd& test_poses_m,
                                         const EvaluateLiftOptions& options,
                                         const ProgressFn& progress) {
  const Layout* layout = FindLayout(options.layout);
  if (!layout) throw std::invalid_argument("no layout " + options.layout);
  const auto total =
      static_cast<double>(methods.size() * options.views.size() * options.noises_m.size()) *
      options.num_poses;
  std::atomic<int> done = 0;
  const auto advance = [&] {
    const int now = ++done;
    if (progress) progress(now / total);
  };
  std::vector<LiftEvaluation> evaluations;
  for (const ViewRange& views : options.views)
    for (const double noise_m : options.noises_m) {
      const auto cases = MakeCases(test_poses_m, *layout, views, noise_m, options);
      for (const LiftMethod& method : methods) {
        LiftEvaluation evaluation = Evaluate(method, cases, advance);
        evaluation.views = views.name;
        evaluation.noise_mm = 1e3 * noise_m;
        evaluations.push_back(std::move(evaluation));
      }
    }
  return evaluations;
}

}  // namespace poselift
