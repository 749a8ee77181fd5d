// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/eval/evaluate_motion.h"

#include <algorithm>
#include <atomic>

#include "lift/eval/pose_error.h"
#include "lift/eval/thread_time.h"
#include "src/forward_kinematics.h"
#include "src/layout.h"

namespace poselift {
namespace {

std::vector<TargetPoint> Observe(const ControlPoints& control, const Pose3& joints_in_world_m,
                                 double sigma_m) {
  const Layout& layout = *FindLayout("body15");
  std::vector<TargetPoint> observed;
  for (const std::string& name : control.landmarks) {
    const auto& parts = layout.landmarks[static_cast<size_t>(layout.Find(name).value())].parts;
    observed.push_back({parts, SumOfJoints(parts, joints_in_world_m), 1.0 / sigma_m});
  }
  return observed;
}

MotionEvaluation Run(const NamedMotionMethod& named, const MotionTrial& trial,
                     const ControlPoints& control, const EvaluateMotionOptions& options) {
  const Skeleton& skeleton = trial.motion.skeleton;
  const JointSites sites = FindJointSites(skeleton);
  const auto& frames = trial.motion.frames;
  const auto first = static_cast<size_t>(options.num_first_poses);
  const size_t end = std::min(frames.size(), first + static_cast<size_t>(options.max_frames));
  const std::unique_ptr<MotionMethod> method = named.make();
  method->Begin({frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(first)});

  MotionEvaluation row{named.name, trial.action, trial.name, control.name};
  Pose3 error_1 = Pose3::Zero(3, kNumJoints), error_2 = error_1;  // of the last frames
  BoneFrames bones;
  for (size_t t = first; t < end; ++t) {
    ForwardKinematics(skeleton, frames[t], &bones);
    const Pose3 truth_m = JointPositions(sites, bones);
    const auto observed = Observe(control, truth_m, options.sigma_m);
    const double before_ms = ThreadTime_ms();
    const SkeletonPose pose = method->Next(observed);
    row.ms_per_frame += ThreadTime_ms() - before_ms;
    ForwardKinematics(skeleton, pose, &bones);
    const Pose3 error = JointPositions(sites, bones) - truth_m;
    row.position_mm += 1e3 * error.colwise().norm().mean();
    row.acceleration_mm += 1e3 * (error - 2.0 * error_1 + error_2).colwise().norm().mean();
    row.angle_deg += MeanAngle_deg(skeleton, pose, frames[t]);
    error_2 = error_1;
    error_1 = error;
    ++row.num_frames;
  }
  const double count = std::max(1, row.num_frames);
  row.position_mm /= count;
  row.acceleration_mm /= count;
  row.angle_deg /= count;
  row.ms_per_frame /= count;
  return row;
}

}  // namespace

const std::vector<ControlPoints>& PaperControlPoints() {
  static const std::vector<ControlPoints> kSets = {
      {"2", {"left_wrist", "right_ankle"}},
      {"3", {"left_wrist", "left_ankle", "right_ankle"}},
      {"4", {"left_wrist", "right_wrist", "left_ankle", "right_ankle"}},
      {"5", {"pelvis", "left_wrist", "right_wrist", "left_ankle", "right_ankle"}},
      {"6", {"head_top", "pelvis", "left_wrist", "right_wrist", "left_ankle", "right_ankle"}}};
  return kSets;
}

std::vector<MotionEvaluation> EvaluateMotion(const std::vector<NamedMotionMethod>& methods,
                                             const std::vector<MotionTrial>& trials,
                                             const EvaluateMotionOptions& options,
                                             const ProgressFn& progress) {
  for (const NamedMotionMethod& method : methods) method.make();  // throws here, not in a thread
  const size_t sets = options.control_points.size();
  std::vector<MotionEvaluation> rows(methods.size() * trials.size() * sets);
  std::atomic<size_t> done = 0;
#pragma omp parallel for schedule(dynamic)
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i] = Run(methods[i / (trials.size() * sets)], trials[i / sets % trials.size()],
                  options.control_points[i % sets], options);
    const size_t now = ++done;
    if (progress) progress(static_cast<double>(now) / static_cast<double>(rows.size()));
  }
  return rows;
}

}  // namespace poselift
