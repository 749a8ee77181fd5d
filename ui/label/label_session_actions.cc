// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What keys and menus do to a session.
#include <algorithm>
#include <array>

#include "lift/lifted_files.h"
#include "src/translated.h"
#include "ui/label/label_edits.h"
#include "ui/label/label_session.h"
#include "ui/label/suggested_frame.h"

namespace poselift {
namespace {

bool HasLabels(const FrameLabels& frame) {
  return std::ranges::any_of(frame.people,
                             [](const PersonLabels& person) { return !person.landmarks.empty(); });
}

// The frame at hand where the edit is of it too, or of none.
size_t FrameToSee(const LabelEdit& edit, size_t at_hand) {
  return edit.people.empty() || edit.people.contains(at_hand) ? at_hand
                                                              : edit.people.begin()->first;
}

// The first frames of the videos beside that of a frame; the frame itself where there is none.
size_t NextVideo(const Labels& labels, size_t frame) {
  const auto next = static_cast<size_t>(FramesOfVideo(labels, frame).last) + 1;
  return next < labels.frames.size() ? next : frame;
}

size_t PreviousVideo(const Labels& labels, size_t frame) {
  const auto first = static_cast<size_t>(FramesOfVideo(labels, frame).first);
  return first > 0 ? static_cast<size_t>(FramesOfVideo(labels, first - 1).first) : frame;
}

bool HasLabelsByHand(const FrameLabels& frame) {
  return std::ranges::any_of(frame.people, [](const PersonLabels& person) {
    return !person.landmarks.empty() && !person.is_propagated;
  });
}

}  // namespace

size_t LabelSession::NumLabels() const {
  if (labels().frames.empty() || !HasPerson()) return 0;
  return labels().frames[frame_index_].people[person_index_].landmarks.size();
}

size_t LabelSession::NumLabelledFrames() const {
  return static_cast<size_t>(std::ranges::count_if(labels().frames, HasLabelsByHand));
}

size_t LabelSession::NextWhere(bool is_labelled, int step) const {
  const auto& frames = labels().frames;
  for (auto i = static_cast<std::ptrdiff_t>(frame_index_) + step; i >= 0 && i < std::ssize(frames);
       i += step)
    if (HasLabels(frames[static_cast<size_t>(i)]) == is_labelled) return static_cast<size_t>(i);
  return frame_index_;
}

// The frame that a key goes to; nothing for other actions.
std::optional<size_t> LabelSession::GoalOf(Action action) const {
  const LabelStep* const last = project_->history().steps().back();
  switch (action) {
    case Action::kFirstFrame:
      return 0;
    case Action::kLastFrame:
      return labels().frames.size();
    case Action::kNextVideo:
      return NextVideo(labels(), frame_index_);
    case Action::kPreviousVideo:
      return PreviousVideo(labels(), frame_index_);
    case Action::kNextUnlabelled:
      return NextWhere(false, 1);
    case Action::kNextLabelled:
      return NextWhere(true, 1);
    case Action::kPreviousLabelled:
      return NextWhere(true, -1);
    case Action::kLastChanged:
      if (!last) return frame_index_;
      if (last->edit.people.empty() && !last->edit.added.empty())
        return labels().frames.size() - last->edit.added.size();
      return FrameToSee(last->edit, frame_index_);
    default:
      return std::nullopt;
  }
}

bool LabelSession::Do(Action action) {
  if (labels().frames.empty()) return false;
  notice_.clear();
  nearer_.reset();
  return DoMotion(action) || DoGo(action) || DoOnLandmark(action) || DoOnPerson(action) ||
         DoHint(action) || DoKeys(action) || DoFlow(action) || DoPose(action) ||
         DoOnProject(action);
}

bool LabelSession::DoGo(Action action) {
  struct Jump {
    Action action;
    std::ptrdiff_t by;
  };
  constexpr std::array kJumps = {Jump{Action::kNextFrame, 1},    Jump{Action::kPreviousFrame, -1},
                                 Jump{Action::kForward10, 10},   Jump{Action::kBack10, -10},
                                 Jump{Action::kForward100, 100}, Jump{Action::kBack100, -100}};
  if (const auto* const jump = std::ranges::find(kJumps, action, &Jump::action);
      jump != kJumps.end()) {
    const bool is_behind_it = between_ && jump->by < 0;  // the one at hand is the one before
    const auto to = static_cast<std::ptrdiff_t>(frame_index_) + jump->by + (is_behind_it ? 1 : 0);
    GoToFrame(static_cast<size_t>(std::max<std::ptrdiff_t>(to, 0)));
    return true;
  }
  if (const auto goal = GoalOf(action)) {
    GoToFrame(*goal);
    return true;
  }
  const int count = static_cast<int>(layout_->landmarks.size());
  switch (action) {
    case Action::kSuggested:
      if (HasKeyFrames()) return true;  // there is no picture to label
      if (const auto frame = SuggestedFrame(labels(), PersonOfMotion(), motion()))
        GoToFrame(*frame);
      else
        notice_ = Translated("all pictures have labels");
      return true;
    case Action::kNextJoint:
      GoToLandmark((landmark_ + 1) % count);
      return true;
    case Action::kPreviousJoint:
      GoToLandmark((landmark_ + count - 1) % count);
      return true;
    default:
      return false;
  }
}

bool LabelSession::DoOnLandmark(Action action) {
  struct Nudge {
    Action action;
    double x_px, y_px;
  };
  constexpr std::array kNudges = {
      Nudge{Action::kNudgeLeft, -0.1, 0.0}, Nudge{Action::kNudgeRight, 0.1, 0.0},
      Nudge{Action::kNudgeUp, 0.0, -0.1},   Nudge{Action::kNudgeDown, 0.0, 0.1},
      Nudge{Action::kStepLeft, -1.0, 0.0},  Nudge{Action::kStepRight, 1.0, 0.0},
      Nudge{Action::kStepUp, 0.0, -1.0},    Nudge{Action::kStepDown, 0.0, 1.0}};
  const std::string_view name = layout_->landmarks[static_cast<size_t>(landmark_)].name;
  const bool has_label = HasLabelAtHand();
  if (const auto* const nudge = std::ranges::find(kNudges, action, &Nudge::action);
      nudge != kNudges.end()) {
    if (has_label) Apply(NudgeLandmark(labels(), Ref(), name, {nudge->x_px, nudge->y_px}));
    return true;
  }
  switch (action) {
    case Action::kCycleState:
      if (has_label) Apply(CycleLandmarkState(labels(), Ref(), name));
      return true;
    case Action::kRemove:
      if (has_label) Apply(RemoveLandmark(labels(), Ref(), name));
      return true;
    default:
      return false;
  }
}

bool LabelSession::DoOnPerson(Action action) {
  const size_t num_people = labels().frames[frame_index_].people.size();
  const bool has_person = person_index_ < num_people;
  switch (action) {
    case Action::kNextPerson:
      GoToPerson(num_people == 0 ? 0 : (person_index_ + 1) % num_people);
      return true;
    case Action::kNewPerson:
      GoToPerson(num_people);
      return true;
    case Action::kRemovePerson:
      if (has_person) Apply(RemovePerson(labels(), Ref()));
      GoToPerson(0);
      return true;
    case Action::kSwapSides:
      if (has_person) Apply(SwapSides(labels(), Ref()));
      return true;
    case Action::kCopyPrevious:
      if (const PersonRef before{frame_index_ - 1, Ref().id};
          frame_index_ > 0 && FindPerson(labels(), before))
        Apply(CopyPerson(labels(), before, frame_index_));
      return true;
    case Action::kNextPose:
      if (result_.poses.empty()) return true;
      pose_index_ = (pose_index_ + 1) % result_.poses.size();
      chosen_in_cam_m_.reset();
      if (pose_index_ > 0) chosen_in_cam_m_ = pose()->joints_in_cam_m;
      return true;
    default:
      return false;
  }
}

bool LabelSession::DoOnProject(Action action) {
  switch (action) {
    case Action::kSave:
      project_->Save();
      return true;
    case Action::kStop:
      Stop();
      return true;
    case Action::kUndo:
    case Action::kRedo: {
      drag_.reset();
      chosen_in_cam_m_.reset();
      const LabelSteps& steps = project_->history().steps();
      const LabelStep* const step = action == Action::kUndo ? steps.back() : steps.forward();
      const size_t seen = step ? FrameToSee(step->edit, frame_index_) : frame_index_;
      action == Action::kUndo ? project_->Undo() : project_->Redo();
      if (labels().frames.empty()) return true;
      // What changes unseen surprises; and the frame at hand may be one that went.
      if (seen != frame_index_ || seen >= labels().frames.size()) GoToFrame(seen);
      person_index_ = std::min(person_index_, labels().frames[frame_index_].people.size());
      LabelsChanged();
      Ask();
      return true;
    }
    default:
      return false;
  }
}

std::vector<TrailPoint> LabelSession::Trail() const {
  if (labels().frames.empty() || !HasPerson()) return {};
  return TrailOf(labels(), Ref(), layout_->landmarks[static_cast<size_t>(landmark_)].name);
}

void LabelSession::TurnPersonBy(double angle_rad) {
  if (HasPerson()) Apply(RotatePerson(labels(), Ref(), angle_rad));
}

void LabelSession::ScalePersonBy(double factor) {
  if (HasPerson()) Apply(ScalePerson(labels(), Ref(), factor));
}

}  // namespace poselift
