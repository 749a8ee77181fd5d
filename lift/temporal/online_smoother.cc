// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/online_smoother.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lift/temporal/pose_difference.h"

namespace poselift {
namespace {

using Array = Eigen::Array<double, kNumFeatures, 1>;

constexpr double kFirstNoise = 0.05, kLeastNoise = 0.002;  // radians and metres
constexpr double kNoiseMemory_s = 2.0;
// A third difference of so many standard deviations is no noise but a leap.
constexpr double kLeap = 4.0;
constexpr double kFramesBeforeLeaps = 15.0;
constexpr double kOutlier = 2.5;

// Of angles that are the same rotation those that are nearest.
void Unwrap(const SkeletonPose& before, SkeletonPose* pose) {
  for (Eigen::Index d = 0; d < pose->dofs.size(); ++d)
    pose->dofs[d] =
        before.dofs[d] + std::remainder(pose->dofs[d] - before.dofs[d], 2.0 * std::numbers::pi);
}

}  // namespace

OnlineSmoother::OnlineSmoother(std::shared_ptr<const MotionCodebook> codebook,
                               const MotionFilterOptions& options)
    : filter_(codebook, codebook->skeleton, options),
      noise_variance_(FeatureVector::Constant(kFirstNoise * kFirstNoise)) {}

void OnlineSmoother::Add(double time_s, const SkeletonPose& pose) {
  const bool is_measured = IsKnown(pose);
  const auto prediction = filter_.Next(time_s, is_measured);
  if (!prediction || !is_measured) last_measured_.clear();
  if (!is_measured) return;
  SkeletonPose measured = pose;
  if (prediction) {
    Unwrap(prediction->pose, &measured);
    LearnNoise({time_s, measured});
    Update(measured, *prediction);
  } else {
    filter_.Measure(measured, noise_variance_);
  }
  last_measured_.push_front({time_s, measured});
  if (last_measured_.size() > 3) last_measured_.pop_back();
}

void OnlineSmoother::Update(const SkeletonPose& measured,
                            const MotionFilter::Prediction& prediction) {
  const Array variances = prediction.variances;
  const Array innovation = PoseDifference(measured, prediction.pose);
  Array total = variances + noise_variance_.array();
  // What is far off draws no harder than what is kOutlier deviations away (Huber).
  total *= (innovation.abs() / (kOutlier * total.sqrt())).max(1.0);
  const Array gain = variances / total;
  filter_.Measure(MovedBy(prediction.pose, gain * innovation), (1.0 - gain) * variances);
}

// Of four poses in a row: third (divided) differences, which hardly know motion.
// At even steps they have sqrt(20) times the size of the noise.
void OnlineSmoother::LearnNoise(const Measured& measured) {
  if (last_measured_.size() < 3) return;
  const double times_s[] = {measured.time_s, last_measured_[0].time_s, last_measured_[1].time_s,
                            last_measured_[2].time_s};
  Array third = Array::Zero();  // of differences to the newest: its own is nought
  double squares = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    double weight = 1.0;
    for (size_t j = 0; j < 4; ++j)
      if (j != i) weight *= (times_s[0] - times_s[1]) / (times_s[i] - times_s[j]);
    squares += weight * weight;
    if (i > 0) third += weight * PoseDifference(last_measured_[i - 1].pose, measured.pose).array();
  }
  Array now = third.square() / squares;
  if (num_learned_ > kFramesBeforeLeaps) now = now.min(kLeap * kLeap * noise_variance_.array());
  const double dt_s = times_s[0] - times_s[1];
  const double share = std::max(1.0 / ++num_learned_, dt_s / kNoiseMemory_s);
  noise_variance_ += std::min(1.0, share) * (now.matrix() - noise_variance_);
  noise_variance_ = noise_variance_.cwiseMax(kLeastNoise * kLeastNoise);
}

}  // namespace poselift
