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

size_t NearestPose(const std::vector<LiftedPose>& poses, const Pose3& to_m) {
  const auto nearest = std::ranges::min_element(poses, {}, [&](const LiftedPose& pose) {
    return (pose.joints_in_cam_m - to_m).squaredNorm();
  });
  return static_cast<size_t>(nearest - poses.begin());
}

}  // namespace

void LabelSession::Ask() {
  const FrameLabels frame = Frame();
  Observation observation;
  if (person_index_ < frame.people.size())
    observation = Observe(frame.people[person_index_], *layout_);
  if (asked_person_ != person_index_) chosen_in_cam_m_.reset();
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
  ShowWhatWasChosen();
  return true;
}

// While a drag goes on its pose is followed; once what comes is the best again, nothing is chosen.
void LabelSession::ShowWhatWasChosen() {
  const bool is_dragged = drag_ && drag_->edit;
  const bool is_chosen = chosen_in_cam_m_ || (is_dragged && drag_->pose);
  pose_index_ = chosen_in_cam_m_ ? NearestPose(result_.poses, *chosen_in_cam_m_) : 0;
  chosen_in_cam_m_.reset();
  if (is_chosen && pose() && (is_dragged || pose_index_ > 0))
    chosen_in_cam_m_ = pose()->joints_in_cam_m;
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
