// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/motion_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lift/normalize.h"
#include "lift/temporal/pose_difference.h"
#include "src/input_error.h"

namespace poselift {
namespace {

using Kind = SmoothedFrame::Kind;
using Array = Eigen::Array<double, kNumFeatures, 1>;

constexpr double kFirstRate = 2.0;  // radians, metres, per second
constexpr double kFallMemory_s = 0.2, kRiseMemory_s = 10.0;
constexpr double kLeastDensity = 0.02;  // of accelerations, per second cubed
constexpr double kTimeTolerance_s = 1e-6, kLongestStep_s = 0.5;

// 1 for angles; for lengths how much larger the other body is.
FeatureVector LengthRatios(const Skeleton& from, const Skeleton& to) {
  FeatureVector ratios = FeatureVector::Ones();
  const double ratio = BoneLengths(to).sum() / BoneLengths(from).sum();
  ratios[feature::kHeight] = ratio;
  ratios.segment<2>(feature::kVelocity).setConstant(ratio);
  return ratios;
}

}  // namespace

std::string MotionFilterOptions::Validate() const {
  if (!(latency_s >= 0.0 && latency_s <= 10.0))
    return fmt::format("MotionFilterOptions::latency_s = {}, wanted 0 to 10", latency_s);
  if (!(max_gap_s >= 0.0 && max_gap_s <= 10.0))
    return fmt::format("MotionFilterOptions::max_gap_s = {}, wanted 0 to 10", max_gap_s);
  if (!(variance_scale > 0.0))
    return fmt::format("MotionFilterOptions::variance_scale = {}, wanted > 0", variance_scale);
  return "";
}

MotionFilter::MotionFilter(std::shared_ptr<const MotionCodebook> codebook, const Skeleton& body,
                           const MotionFilterOptions& options)
    : codebook_(std::move(codebook)),
      options_(options),
      body_(body),
      to_model_(LengthRatios(body, codebook_->skeleton)),
      model_(*codebook_) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
}

std::optional<MotionFilter::Prediction> MotionFilter::Next(double time_s, bool will_measure) {
  const Frame* before = !frames_.empty() ? &frames_.back()
                        : newest_taken_  ? &*newest_taken_
                                         : nullptr;
  if (before && !(time_s > before->time_s))
    throw InputError(fmt::format("found a frame at {} s after one at {} s, wanted a later time",
                                 time_s, before->time_s));
  Frame frame;
  frame.time_s = time_s;
  if (before && GoesOn(*before, time_s, will_measure)) {
    frame.dt_s = time_s - before->time_s;
    frame.kind = Kind::kFilled;
    Predict(*before, &frame);
  }
  frames_.push_back(std::move(frame));
  const Frame& newest = frames_.back();
  if (newest.kind == Kind::kNotKnown) return std::nullopt;
  return Prediction{newest.predicted, newest.predicted_covariance.xx};
}

void MotionFilter::Measure(const SkeletonPose& pose, const FeatureVector& variances) {
  Frame& frame = frames_.back();
  if (frame.kind == Kind::kNotKnown) {
    frame.predicted = pose;
    frame.predicted_rates = FeatureVector::Zero();
    frame.predicted_covariance = {variances, FeatureVector::Zero(),
                                  FeatureVector::Constant(kFirstRate * kFirstRate)};
  }
  // What was measured says of the rates what it says of the values.
  const Array difference = PoseDifference(pose, frame.predicted);
  const Array xx = frame.predicted_covariance.xx, xv = frame.predicted_covariance.xv;
  const Array share = xv / xx, less = xx - variances.array();
  frame.kind = Kind::kMeasured;
  frame.filtered = pose;
  frame.rates = frame.predicted_rates.array() + share * difference;
  frame.covariance.xx = variances;
  frame.covariance.xv = share * variances.array();
  frame.covariance.vv = frame.predicted_covariance.vv.array() - share.square() * less;
  measured_s_ = frame.time_s;
  LearnFloor(pose, frame.dt_s);
}

void MotionFilter::StartAnew() {
  frames_.back().kind = Kind::kNotKnown;
  frames_.back().dt_s = 0.0;
}

std::optional<SkeletonPose> MotionFilter::Ahead(double time_s) const {
  const Frame* newest = !frames_.empty() ? &frames_.back()
                        : newest_taken_  ? &*newest_taken_
                                         : nullptr;
  if (!newest || newest->kind == Kind::kNotKnown) return std::nullopt;
  return MovedBy(newest->filtered, (time_s - newest->time_s) * newest->rates);
}

// A frame that is measured may follow any that is known, if its step is one.
bool MotionFilter::GoesOn(const Frame& before, double time_s, bool will_measure) const {
  if (before.kind == Kind::kNotKnown || !IsKnown(before.filtered)) return false;
  return will_measure ? time_s - before.time_s < std::max(options_.max_gap_s, kLongestStep_s)
                      : time_s - measured_s_ <= options_.max_gap_s + kTimeTolerance_s;
}

std::optional<SmoothedFrame> MotionFilter::Take() {
  if (frames_.empty()) return std::nullopt;
  const double waited_s = frames_.back().time_s - frames_.front().time_s;
  if (!has_ended_ && waited_s < options_.latency_s - kTimeTolerance_s) return std::nullopt;
  SmoothedFrame smoothed = SmoothOldest();
  newest_taken_ = std::move(frames_.front());
  frames_.pop_front();
  return smoothed;
}

void MotionFilter::Predict(const Frame& before, Frame* frame) {
  const double dt = frame->dt_s;
  SkeletonPose as_captured = before.filtered;
  TakeAnglesNearestToRest(codebook_->skeleton, &as_captured);
  FeatureVector features = PoseFeatures(as_captured);
  features[feature::kHeight] -= floor_m_;
  const AccelerationModel::Prediction& in_model =
      model_.At(features.cwiseProduct(to_model_), before.rates.cwiseProduct(to_model_));
  const FeatureVector acceleration = in_model.mean.cwiseQuotient(to_model_);
  frame->predicted_rates = before.rates + dt * acceleration;
  frame->predicted = MovedBy(before.filtered, dt * (before.rates + 0.5 * dt * acceleration));
  // An acceleration that holds for kAccelerationTime_s, as white noise.
  const Array density = options_.variance_scale * kAccelerationTime_s * in_model.variance.array() /
                            to_model_.array().square() +
                        kLeastDensity;
  const Array xx = before.covariance.xx, xv = before.covariance.xv, vv = before.covariance.vv;
  frame->predicted_covariance.xx =
      xx + 2.0 * dt * xv + dt * dt * vv + density * (dt * dt * dt / 3.0);
  frame->predicted_covariance.xv = xv + dt * vv + density * (dt * dt / 2.0);
  frame->predicted_covariance.vv = vv + density * dt;
  frame->filtered = frame->predicted;
  frame->rates = frame->predicted_rates;
  frame->covariance = frame->predicted_covariance;
}

// Soon down, slowly up: a jump is no new floor, nor is one wrong frame.
void MotionFilter::LearnFloor(const SkeletonPose& pose, double dt_s) {
  const double lowest_m = JointPositions(body_, pose).row(1).minCoeff();
  const double memory_s = lowest_m < floor_m_ ? kFallMemory_s : kRiseMemory_s;
  if (std::isinf(floor_m_)) floor_m_ = lowest_m;
  floor_m_ += std::min(1.0, dt_s / memory_s) * (lowest_m - floor_m_);
}

SmoothedFrame MotionFilter::SmoothOldest() const {
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
