// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/smooth_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lift/baselines/motion_curves.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kMillimetres = 1000.0;

std::vector<bool> KnownFrames(const Motion& motion) {
  std::vector<bool> known;
  for (const SkeletonPose& pose : motion.frames) known.push_back(IsKnown(pose));
  return known;
}

// Also what a smoother may not fill, so that every frame can be written.
Motion Bridged(const Motion& motion) {
  const MotionCurves curves(motion);
  return curves.ToMotion(FillGaps(curves.curves(), GapFill::kLinear).curves);
}

// Mean length of the 3-vectors that are stacked in the columns.
class MeanLength {
 public:
  void Add(const Eigen::VectorXd& stacked) {
    for (Eigen::Index i = 0; i + 2 < stacked.size(); i += 3) sum_ += stacked.segment<3>(i).norm();
    count_ += stacked.size() / 3;
  }
  double Mm() const { return count_ > 0 ? kMillimetres * sum_ / static_cast<double>(count_) : -1; }

 private:
  double sum_ = 0.0;
  Eigen::Index count_ = 0;
};

double Moved_mm(const Eigen::MatrixXd& before_m, const Eigen::MatrixXd& after_m,
                const std::vector<bool>& frames) {
  MeanLength mean;
  for (Eigen::Index t = 0; t < before_m.cols(); ++t)
    if (frames[t]) mean.Add(after_m.col(t) - before_m.col(t));
  return mean.Mm();
}

}  // namespace

MotionSmoother SmootherOfCurves(GapFill fill, CurveFilter filter) {
  return [fill, filter = std::move(filter)](const Motion& motion, int max_gap_frames) {
    const MotionCurves curves(motion);
    const FilledCurves filled = FillGaps(curves.curves(), fill, max_gap_frames);
    return curves.ToMotion(filter(filled.curves, 1.0 / motion.frame_time_s));
  };
}

std::string SmoothMotionOptions::Validate() const {
  if (!(max_gap_s >= 0.0 && max_gap_s <= 1e6))
    return fmt::format("SmoothMotionOptions::max_gap_s = {}, wanted 0 to 1e6", max_gap_s);
  return "";
}

SmoothedMotion SmoothMotion(const Motion& motion, const MotionSmoother& smoother,
                            const SmoothMotionOptions& options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  const std::vector<bool> known = KnownFrames(motion);
  if (std::none_of(known.begin(), known.end(), std::identity()))
    throw InputError("found a motion of which no frame is known, wanted at least one");
  constexpr double kRounding = 1e-6;
  const auto max_gap_frames = static_cast<int>(
      std::min(1e9, std::floor(options.max_gap_s / motion.frame_time_s + kRounding)));

  SmoothedMotion smoothed;
  smoothed.motion = smoother(motion, max_gap_frames);
  std::vector<bool> filled = KnownFrames(smoothed.motion);
  std::vector<bool> unknown = filled;
  for (size_t t = 0; t < known.size(); ++t) {
    unknown[t] = !filled[t];
    filled[t] = filled[t] && !known[t];
  }
  smoothed.filled = SpansOf(filled);
  smoothed.unknown = SpansOf(unknown);
  if (!smoothed.unknown.empty()) smoothed.motion = Bridged(smoothed.motion);

  const Eigen::MatrixXd before_m = BoneTips(motion);
  const Eigen::MatrixXd after_m = BoneTips(smoothed.motion);
  smoothed.jitter_before_mm = Jitter_mm(before_m, known);
  smoothed.jitter_after_mm = Jitter_mm(after_m, known);
  smoothed.moved_mm = Moved_mm(before_m, after_m, known);
  return smoothed;
}

Eigen::MatrixXd BoneTips(const Motion& motion) {
  Eigen::MatrixXd tips_m(3 * std::ssize(motion.skeleton.bones), std::ssize(motion.frames));
  BoneFrames frames;
  for (Eigen::Index t = 0; t < tips_m.cols(); ++t) {
    ForwardKinematics(motion.skeleton, motion.frames[static_cast<size_t>(t)], &frames);
    tips_m.col(t) = frames.tip_in_world_m.reshaped();
  }
  return tips_m;
}

double Jitter_mm(const Eigen::MatrixXd& tips_in_world_m, const std::vector<bool>& frames) {
  MeanLength mean;
  for (Eigen::Index t = 1; t + 1 < tips_in_world_m.cols(); ++t)
    if (frames[t - 1] && frames[t] && frames[t + 1])
      mean.Add(tips_in_world_m.col(t - 1) - 2.0 * tips_in_world_m.col(t) +
               tips_in_world_m.col(t + 1));
  return mean.Mm();
}

}  // namespace poselift
