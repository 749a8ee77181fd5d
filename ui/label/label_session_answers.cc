// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What is asked of the solver, and which of its answers are shown.
#include <algorithm>
#include <limits>

#include "src/observation.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();

}  // namespace

void LabelSession::Ask() {
  const FrameLabels frame = Frame();
  Observation observation;
  if (person_index_ < frame.people.size())
    observation = Observe(frame.people[person_index_], *layout_);
  const std::scoped_lock lock(mutex_);
  asked_observation_ = observation;
  if (is_playing_ && ShowsMotion()) {
    result_ = {};
    asked_ = answered_ = 0;
    first_wanted_ = kNone;  // what is still being solved is of a frame gone by
    return;
  }
  PoseRequest request{std::move(observation)};
  const bool goes_on = drag_ && drag_->edit && asked_person_ == person_index_;
  if (goes_on && answered_ >= first_wanted_ && pose()) request.start = *pose();
  asked_ = solver_.Ask(std::move(request));
  asked_person_ = person_index_;
  first_wanted_ = goes_on ? std::min(first_wanted_, asked_) : asked_;
}

bool LabelSession::TakeAnswer() {
  const bool is_followed = TakeFollowed(), has_motion = TakeMotion();
  const std::scoped_lock lock(mutex_);
  // An older one is of labels that are no more.
  if (!waiting_ || waiting_->number < first_wanted_) return is_followed || has_motion;
  result_ = std::move(waiting_->result);
  observation_ = std::move(waiting_->observation);
  answered_ = waiting_->number;
  waiting_.reset();
  pose_index_ = 0;
  return true;
}

void LabelSession::WaitUntilSolved() {
  solver_.WaitUntilIdle();
  TakeAnswer();
}

const LiftedPose* LabelSession::pose() const {
  return pose_index_ < result_.poses.size() ? &result_.poses[pose_index_] : nullptr;
}

std::optional<double> LabelSession::Residual_px(std::string_view landmark) const {
  const LiftedPose* lifted = ShownPose();
  if (!lifted) return std::nullopt;
  const auto& points = observation().points;
  for (Eigen::Index i = 0; i < std::min(std::ssize(points), lifted->point_errors.size()); ++i) {
    const ObservedPoint& point = points[static_cast<size_t>(i)];
    if (point.name == landmark && point.kind == ObservedPoint::Kind::k2D)
      return lifted->point_errors[i];
  }
  return std::nullopt;
}

std::optional<double> LabelSession::ResidualInSigmas(std::string_view landmark) const {
  const auto residual_px = Residual_px(landmark);
  const auto& points = observation().points;
  const auto point = std::ranges::find(points, landmark, &ObservedPoint::name);
  if (!residual_px || point == points.end()) return std::nullopt;
  return *residual_px / point->sigma;
}

}  // namespace poselift
