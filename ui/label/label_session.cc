// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_session.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/input_error.h"
#include "src/translated.h"
#include "ui/label/in_words.h"
#include "ui/label/label_edits.h"

namespace poselift {
namespace {

constexpr double kShake = 0.3;  // of the reach

}  // namespace

LabelSession::LabelSession(LabelProject* project, const PhotoLifter& lifter,
                           std::function<void()> answered)
    : project_(project),
      lifter_(lifter),
      layout_(FindLayout(project->labels().layout)),
      wake_(std::move(answered)),
      solver_(lifter,
              [this](PoseSolver::Answer answer) {
                {
                  const std::scoped_lock lock(mutex_);
                  waiting_ = std::move(answer);
                }
                if (wake_) wake_();
              }),
      follow_job_(wake_),
      motion_job_(wake_),
      export_job_(wake_) {
  if (!layout_) throw InputError("found labels without a layout, wanted one, such as body15");
  handles_ = PoseHandles(*layout_);
  GoToFrame(0);
  LabelsChanged();
}

const LandmarkLabel* LabelSession::Find(const PersonLabels& person, std::string_view landmark) {
  const auto found = std::ranges::find(person.landmarks, landmark, &LandmarkLabel::name);
  return found == person.landmarks.end() ? nullptr : &*found;
}

PersonRef LabelSession::Ref() const {
  const auto& people = labels().frames[frame_index_].people;
  return {frame_index_, person_index_ < people.size() ? people[person_index_].id
                                                      : FreePersonId(labels(), frame_index_)};
}

FrameLabels LabelSession::Frame() const {
  if (labels().frames.empty()) return {};
  FrameLabels frame = labels().frames[frame_index_];
  if (!drag_ || !drag_->edit) return frame;
  const auto dragged = drag_->edit->people.find(frame_index_);
  if (dragged != drag_->edit->people.end()) frame.people = dragged->second;
  return frame;
}

void LabelSession::Press(const Eigen::Vector2d& x_px, double reach_px) {
  if (labels().frames.empty()) return;
  const FrameLabels& frame = labels().frames[frame_index_];
  notice_.clear();
  drag_ = Drag{x_px, kShake * reach_px, person_index_, landmark_};
  const auto hit = HitLandmark(frame, x_px, reach_px, person_index_);
  if (const auto nearer = std::exchange(nearer_, std::nullopt)) {
    drag_.reset();
    if (!hit || hit->person != person_index_) return;
    const std::string farther = frame.people[hit->person].landmarks[hit->landmark].name;
    return Give({{.kind = LabelHint::Kind::kNearer,
                  .joint = std::string(layout_->landmarks[static_cast<size_t>(*nearer)].name),
                  .other = farther}});
  }
  if (hit) {
    const LandmarkLabel& label = frame.people[hit->person].landmarks[hit->landmark];
    person_index_ = hit->person;
    landmark_ = layout_->Find(label.name).value_or(landmark_);
    drag_->is_new = false;
    drag_->grab_px = label.x_px - x_px;
    return;  // Release tells a click
  }
  Move(x_px);
}

void LabelSession::PressPerson(const Eigen::Vector2d& x_px) {
  if (labels().frames.empty() || !HasPerson()) return;
  drag_ = Drag{.pressed_px = x_px, .is_new = false, .is_person = true};
}

void LabelSession::Move(const Eigen::Vector2d& x_px) {
  if (!drag_) return;
  if (drag_->is_person) {
    drag_->edit = MovePerson(labels(), Ref(), x_px - drag_->pressed_px);
    return Ask();
  }
  const bool is_click = !drag_->edit && (x_px - drag_->pressed_px).norm() < drag_->shake_px;
  if (!drag_->is_new && is_click) return;
  const std::string_view name = layout_->landmarks[static_cast<size_t>(landmark_)].name;
  const Eigen::Vector2d to_px = x_px + drag_->grab_px;
  drag_->edit = drag_->is_new ? PlaceLandmark(labels(), Ref(), name, to_px)
                              : MoveLandmark(labels(), Ref(), name, to_px);
  Ask();
}

void LabelSession::Release() {
  if (!drag_) return;
  Drag drag = *std::exchange(drag_, std::nullopt);
  if (!drag.edit && (drag.is_person || drag.pose)) return;
  if (!drag.edit) {
    // A click near a landmark: joints may lie on each other.
    const size_t hit_person = std::exchange(person_index_, drag.person_before);
    const int hit_landmark = std::exchange(landmark_, drag.landmark_before);
    if (HasLabelAtHand()) {
      person_index_ = hit_person;
      landmark_ = hit_landmark;
      return;
    }
    const std::string_view name = layout_->landmarks[static_cast<size_t>(landmark_)].name;
    drag.edit = PlaceLandmark(labels(), Ref(), name, drag.pressed_px);
    drag.is_new = true;
  }
  const uint64_t asked_on_the_way = asked_;
  Apply(*drag.edit);
  if (asked_ == asked_on_the_way) Ask();  // refused, or nothing: the labels are as they were
  if (drag.is_new) Advance();
}

bool LabelSession::HasLabelAtHand() const {
  const auto& people = labels().frames[frame_index_].people;
  return person_index_ < people.size() &&
         Find(people[person_index_], layout_->landmarks[static_cast<size_t>(landmark_)].name);
}

bool LabelSession::CycleStateAt(const Eigen::Vector2d& x_px, double reach_px) {
  if (labels().frames.empty()) return false;
  const auto hit = HitLandmark(labels().frames[frame_index_], x_px, reach_px, person_index_);
  if (!hit) return false;
  person_index_ = hit->person;
  const auto& landmarks = labels().frames[frame_index_].people[hit->person].landmarks;
  landmark_ = layout_->Find(landmarks[hit->landmark].name).value_or(landmark_);
  return Do(Action::kCycleState);
}

void LabelSession::GoToFrame(size_t index) {
  if (labels().frames.empty()) return;
  drag_.reset();
  hovered_.reset();
  between_.reset();
  chosen_in_cam_m_.reset();
  frame_index_ = std::min(index, labels().frames.size() - 1);
  person_index_ =
      std::min(person_index_, std::max<size_t>(labels().frames[frame_index_].people.size(), 1) - 1);
  landmark_ = -1;
  Advance();
  Ask();
}

void LabelSession::GoToPerson(size_t index) {
  if (labels().frames.empty()) return;
  person_index_ = std::min(index, labels().frames[frame_index_].people.size());
  landmark_ = -1;
  Advance();
  Ask();
}

void LabelSession::GoToLandmark(int landmark) {
  landmark_ = std::clamp(landmark, 0, static_cast<int>(layout_->landmarks.size()) - 1);
}

void LabelSession::TypeDigit(int digit, double now_s) {
  GoToLandmark(typed_.Type(digit, static_cast<int>(layout_->landmarks.size()), now_s) - 1);
}

// The next one without a label; the next one where all have one.
void LabelSession::Advance() {
  const int count = static_cast<int>(layout_->landmarks.size());
  const auto& people = labels().frames[frame_index_].people;
  for (int step = 1; step <= count; ++step) {
    const int next = (landmark_ + step) % count;
    if (person_index_ < people.size() &&
        Find(people[person_index_], layout_->landmarks[static_cast<size_t>(next)].name))
      continue;
    landmark_ = next;
    return;
  }
  landmark_ = std::max(landmark_, 0);
}

void LabelSession::Apply(LabelEdit edit) {
  try {
    if (!project_->Apply(std::move(edit))) return;
    frame_index_ = std::min(frame_index_, labels().frames.size() - 1);  // it may be one that went
    LabelsChanged();
    Ask();
  } catch (const InputError& error) {  // of what labels cannot hold, or of others who hold them
    notice_ = error.what();
  }
}

std::filesystem::path LabelSession::PicturePath() const {
  if (labels().frames.empty()) return {};
  const std::string& image = labels().frames[frame_index_].image;
  return image.empty() ? std::filesystem::path() : project_->dir() / image;
}

std::string LabelSession::Title() const {
  std::string title = project_->path().filename().string();
  if (!labels().frames.empty() && !labels().frames[frame_index_].image.empty())
    title += ": " + labels().frames[frame_index_].image;
  if (project_->read_only()) title += Translated(" (read only)");
  return title + (project_->IsSaved() ? " - poselift" : " * - poselift");
}

std::string LabelSession::Status() const {
  if (!project_->unsaved_reason().empty())
    return Translated("NOT SAVED: {}", project_->unsaved_reason());
  if (labels().frames.empty()) return Translated("no pictures");
  if (std::string working = Working(); !working.empty()) return working;
  if (!notice_.empty()) return notice_;
  if (nearer_)
    return Translated("click the joint that is farther from the camera than {}",
                      InWords(layout_->landmarks[static_cast<size_t>(*nearer_)].name));
  if (hovered_ && pose()) return HandleStatus(*hovered_);
  if (IsBetween()) return KeyStatus();
  std::string status =
      HasKeyFrames() ? KeyStatus()
                     : Translated("click: {}",
                                  InWords(layout_->landmarks[static_cast<size_t>(landmark_)].name));
  if (ShowsMotion())
    status += "   " +
              (IsMotionCurrent() ? Translated("motion") : Translated("motion (out of date)")) +
              (motion_->is_filled[frame_index_]
                   ? Translated(", filled for want of labels")
                   : fmt::format(", {:.1f} px", MotionPose()->reprojection_rms_px));
  else if (const LiftedPose* lifted = pose())
    status += "   " + Translated("pose {} of {}", pose_index_ + 1, result_.poses.size()) +
              (pose_index_ > 0 ? Translated(", not kept") : std::string()) +
              (lifted->reprojection_rms_px < 0.0
                   ? std::string()
                   : fmt::format(", {:.1f} px", lifted->reprojection_rms_px));
  else
    status += "   " + Translated("no pose yet: {}", Translated(result_.message));
  if (!ShowsMotion() && pose() && !pose()->unmet_hints.empty())
    status += "   " + Translated("hints not met: {}; they contradict each other, or the picture",
                                 pose()->unmet_hints.size());
  return status;
}

}  // namespace poselift
