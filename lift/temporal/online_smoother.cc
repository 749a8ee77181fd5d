// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/online_smoother.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lift/temporal/pose_difference.h"
#include "src/input_error.h"

namespace poselift {
namespace {

using Kind = SmoothedFrame::Kind;
using Array = Eigen::Array<double, kNumFeatures, 1>;

constexpr double kFirstNoise = 0.05, kFirstRate = 2.0;  // radians, metres, per second
constexpr double kNoiseMemory_s = 2.0, kFallMemory_s = 0.2, kRiseMemory_s = 10.0;
constexpr double kLeastDensity = 0.02;  // of accelerations, per second cubed
constexpr double kTimeTolerance_s = 1e-6, kLongestStep_s = 0.5;
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

std::string OnlineSmootherOptions::Validate() const {
  if (!(latency_s >= 0.0 && latency_s <= 10.0))
    return fmt::format("OnlineSmootherOptions::latency_s = {}, wanted 0 to 10", latency_s);
  if (!(max_gap_s >= 0.0 && max_gap_s <= 10.0))
    return fmt::format("OnlineSmootherOptions::max_gap_s = {}, wanted 0 to 10", max_gap_s);
  if (!(variance_scale > 0.0))
    return fmt::format("OnlineSmootherOptions::variance_scale = {}, wanted > 0", variance_scale);
  if (!(least_noise > 0.0))
    return fmt::format("OnlineSmootherOptions::least_noise = {}, wanted > 0", least_noise);
  return "";
}

OnlineSmoother::OnlineSmoother(std::shared_ptr<const MotionCodebook> codebook,
                               const OnlineSmootherOptions& options)
    : codebook_(std::move(codebook)),
      options_(options),
      body_(codebook_->skeleton),
      model_(*codebook_),
      noise_variance_(FeatureVector::Constant(kFirstNoise * kFirstNoise)) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
}

void OnlineSmoother::Add(double time_s, const SkeletonPose& pose) {
  const Frame* before = !frames_.empty() ? &frames_.back()
                        : newest_taken_  ? &*newest_taken_
                                         : nullptr;
  if (before && !(time_s > before->time_s))
    throw InputError(fmt::format("found a frame at {} s after one at {} s, wanted a later time",
                                 time_s, before->time_s));
  Frame frame;
  frame.time_s = time_s;
  const bool is_measured = IsKnown(pose);
  SkeletonPose measured = pose;
  if (!before || !GoesOn(*before, time_s, is_measured)) {
    last_measured_.clear();
    if (is_measured) Start(measured, &frame);
  } else {
    frame.dt_s = time_s - before->time_s;
    Predict(*before, &frame);
    frame.kind = is_measured ? Kind::kMeasured : Kind::kFilled;
    if (is_measured) {
      Unwrap(frame.predicted, &measured);
      LearnNoise({time_s, measured});
      Update(measured, &frame);
    }
  }
  if (is_measured) {
    LearnFloor(frame.filtered, frame.dt_s);
    measured_s_ = time_s;
    last_measured_.push_front({time_s, measured});
    if (last_measured_.size() > 3) last_measured_.pop_back();
  } else {
    last_measured_.clear();
  }
  frames_.push_back(std::move(frame));
}

// A frame that is measured may follow any that is known, if its step is one.
bool OnlineSmoother::GoesOn(const Frame& before, double time_s, bool is_measured) const {
  if (before.kind == Kind::kNotKnown || !IsKnown(before.filtered)) return false;
  return is_measured ? time_s - before.time_s < std::max(options_.max_gap_s, kLongestStep_s)
                     : time_s - measured_s_ <= options_.max_gap_s + kTimeTolerance_s;
}

std::optional<SmoothedFrame> OnlineSmoother::Take() {
  if (frames_.empty()) return std::nullopt;
  const double waited_s = frames_.back().time_s - frames_.front().time_s;
  if (!has_ended_ && waited_s < options_.latency_s - kTimeTolerance_s) return std::nullopt;
  SmoothedFrame smoothed = SmoothOldest();
  newest_taken_ = std::move(frames_.front());
  frames_.pop_front();
  return smoothed;
}

void OnlineSmoother::Start(const SkeletonPose& measured, Frame* frame) const {
  frame->kind = Kind::kMeasured;
  frame->filtered = frame->predicted = measured;
  frame->rates = frame->predicted_rates = FeatureVector::Zero();
  frame->covariance = {noise_variance_, FeatureVector::Zero(),
                       FeatureVector::Constant(kFirstRate * kFirstRate)};
  frame->predicted_covariance = frame->covariance;
}

void OnlineSmoother::Predict(const Frame& before, Frame* frame) {
  const double dt = frame->dt_s;
  SkeletonPose as_captured = before.filtered;
  TakeAnglesNearestToRest(codebook_->skeleton, &as_captured);
  FeatureVector features = PoseFeatures(as_captured);
  features[feature::kHeight] -= floor_m_;
  const AccelerationModel::Prediction& acceleration = model_.At(features, before.rates);
  frame->predicted_rates = before.rates + dt * acceleration.mean;
  frame->predicted = MovedBy(before.filtered, dt * (before.rates + 0.5 * dt * acceleration.mean));
  // An acceleration that holds for kAccelerationTime_s, as white noise.
  const Array density =
      options_.variance_scale * kAccelerationTime_s * acceleration.variance.array() + kLeastDensity;
  const Array xx = before.covariance.xx, xv = before.covariance.xv, vv = before.covariance.vv;
  frame->predicted_covariance.xx =
      xx + 2.0 * dt * xv + dt * dt * vv + density * (dt * dt * dt / 3.0);
  frame->predicted_covariance.xv = xv + dt * vv + density * (dt * dt / 2.0);
  frame->predicted_covariance.vv = vv + density * dt;
  frame->filtered = frame->predicted;
  frame->rates = frame->predicted_rates;
  frame->covariance = frame->predicted_covariance;
}

void OnlineSmoother::Update(const SkeletonPose& measured, Frame* frame) const {
  const Covariance& p = frame->predicted_covariance;
  const Array innovation = PoseDifference(measured, frame->predicted);
  Array total = p.xx.array() + noise_variance_.array();
  // What is far off draws no harder than what is kOutlier deviations away (Huber).
  total *= (innovation.abs() / (kOutlier * total.sqrt())).max(1.0);
  const Array gain_x = p.xx.array() / total, gain_v = p.xv.array() / total;
  frame->filtered = MovedBy(frame->predicted, gain_x * innovation);
  frame->rates = frame->predicted_rates.array() + gain_v * innovation;
  frame->covariance.xx = (1.0 - gain_x) * p.xx.array();
  frame->covariance.xv = (1.0 - gain_x) * p.xv.array();
  frame->covariance.vv = p.vv.array() - gain_v * p.xv.array();
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
  noise_variance_ = noise_variance_.cwiseMax(options_.least_noise * options_.least_noise);
}

// Soon down, slowly up: a jump is no new floor, nor is one wrong frame.
void OnlineSmoother::LearnFloor(const SkeletonPose& pose, double dt_s) {
  const double lowest_m = JointPositions(body_, pose).row(1).minCoeff();
  const double memory_s = lowest_m < floor_m_ ? kFallMemory_s : kRiseMemory_s;
  if (std::isinf(floor_m_)) floor_m_ = lowest_m;
  floor_m_ += std::min(1.0, dt_s / memory_s) * (lowest_m - floor_m_);
}

SmoothedFrame OnlineSmoother::SmoothOldest() const {
  const Frame& oldest = frames_.front();
  SmoothedFrame smoothed{oldest.time_s, oldest.kind, oldest.filtered};
  if (oldest.kind == Kind::kNotKnown) {
    smoothed.pose = UnknownPose(codebook_->skeleton);
    return smoothed;
  }
  // As far as one frame follows from the one before.
  auto last = frames_.begin();
  while (last + 1 != frames_.end() && (last + 1)->dt_s > 0.0) ++last;
  SkeletonPose pose = last->filtered;
  Array rates = last->rates;
  Array xx = last->covariance.xx, xv = last->covariance.xv, vv = last->covariance.vv;
  for (auto next = last; next != frames_.begin(); --next) {
    const Frame& now = *(next - 1);
    const double dt = next->dt_s;
    // G = P F^T P_predicted^-1, 2 x 2 for each feature.
    const Array a = now.covariance.xx.array() + dt * now.covariance.xv.array();
    const Array b = now.covariance.xv.array();
    const Array c = now.covariance.xv.array() + dt * now.covariance.vv.array();
    const Array d = now.covariance.vv.array();
    const Covariance& p = next->predicted_covariance;
    const Array determinant = p.xx.array() * p.vv.array() - p.xv.array().square();
    const Array g_xx = (a * p.vv.array() - b * p.xv.array()) / determinant;
    const Array g_xv = (b * p.xx.array() - a * p.xv.array()) / determinant;
    const Array g_vx = (c * p.vv.array() - d * p.xv.array()) / determinant;
    const Array g_vv = (d * p.xx.array() - c * p.xv.array()) / determinant;
    const Array dx = PoseDifference(pose, next->predicted);
    const Array dv = rates - next->predicted_rates.array();
    pose = MovedBy(now.filtered, g_xx * dx + g_xv * dv);
    rates = now.rates.array() + g_vx * dx + g_vv * dv;
    const Array exx = xx - p.xx.array(), exv = xv - p.xv.array(), evv = vv - p.vv.array();
    xx = now.covariance.xx.array() + g_xx.square() * exx + 2.0 * g_xx * g_xv * exv +
         g_xv.square() * evv;
    xv = now.covariance.xv.array() + g_xx * g_vx * exx + (g_xx * g_vv + g_xv * g_vx) * exv +
         g_xv * g_vv * evv;
    vv = now.covariance.vv.array() + g_vx.square() * exx + 2.0 * g_vx * g_vv * exv +
         g_vv.square() * evv;
  }
  smoothed.pose = pose;
  smoothed.deviations = xx.max(0.0).sqrt();
  return smoothed;
}

}  // namespace poselift
