// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The frames of the person at hand as one motion.
#include <algorithm>

#include "src/translated.h"
#include "ui/label/label_session.h"

namespace poselift {

// In a frame without anybody it is the person of the motion before, or the first there is.
int LabelSession::PersonOfMotion() const {
  const auto& frames = labels().frames;
  if (HasPerson() || frames.empty()) return Ref().id;
  if (motion_) return motion_->person_id;
  const auto somebody =
      std::ranges::find_if(frames, [](const FrameLabels& frame) { return !frame.people.empty(); });
  return somebody == frames.end() ? 0 : somebody->people.front().id;
}

bool LabelSession::DoMotion(Action action) {
  switch (action) {
    case Action::kSmoothMotion:
      motion_job_.Start([&lifter = lifter_, labels = labels(), id = PersonOfMotion(),
                         frame = frame_index_](const ProgressFn& progress) {
        return LiftPersonAsMotion(lifter, labels, id, frame, progress);
      });
      return true;
    case Action::kShowMotion:
      shows_motion = !shows_motion;
      return true;
    case Action::kNextPose:  // of the frame by itself, which is not to be seen yet
      if (!ShowsMotion()) return false;
      shows_motion = false;
      return true;
    default:
      return false;
  }
}

std::optional<double> LabelSession::MotionProgress() const {
  return motion_job_.IsBusy() ? std::optional(motion_job_.Fraction()) : std::nullopt;
}

bool LabelSession::TakeMotion() {
  std::optional<PersonMotion> motion;
  try {
    motion = motion_job_.Take();
  } catch (const std::exception& error) {
    motion = PersonMotion{.message = error.what()};
  }
  if (!motion) return false;
  // One that could not be made does not take away the one before.
  if (!motion->HasPoses() && motion_ && motion_->HasPoses()) {
    notice_ = Translated("no motion: {}", motion->message);
    return true;
  }
  motion->number = ++num_motions_;
  motion_ = std::make_shared<const PersonMotion>(std::move(*motion));
  return true;
}

// What the motion would be made of now; only when labels have changed since it was asked last.
const std::vector<std::uint64_t>& LabelSession::MarksOfMotion() const {
  const std::pair now(project_->history().state(), motion_->number);
  if (marks_.empty() || marks_of_ != now) {
    marks_ = LabelMarks(labels(), motion_->person_id, motion_->video);
    marks_of_ = now;
  }
  return marks_;
}

bool LabelSession::IsMotionCurrent() const {
  return motion_ && MarksOfMotion() == motion_->label_marks;
}

const LiftedPose* LabelSession::MotionPose() const {
  if (!motion_ || (drag_ && drag_->edit)) return nullptr;
  if (HasPerson() && Ref().id != motion_->person_id) return nullptr;
  if (HasKeyFrames())
    return IsBetween() && IsMotionCurrent() ? motion_->PoseOf(MotionFrame()) : nullptr;
  const auto& marks = MarksOfMotion();
  if (frame_index_ >= motion_->label_marks.size() ||
      marks[frame_index_] != motion_->label_marks[frame_index_])
    return nullptr;
  return motion_->PoseOf(frame_index_);
}

bool LabelSession::ShowsMotion() const { return shows_motion && MotionPose(); }

const LiftedPose* LabelSession::ShownPose() const { return ShowsMotion() ? MotionPose() : pose(); }

const Observation& LabelSession::observation() const {
  return ShowsMotion() ? asked_observation_ : observation_;
}

void LabelSession::PlayTo(size_t motion_frame) {
  is_playing_ = true;
  GoToMotionFrame(motion_frame);
  is_playing_ = false;
}

void LabelSession::WaitUntilSmoothed() {
  motion_job_.WaitUntilIdle();
  TakeAnswer();
}

}  // namespace poselift
