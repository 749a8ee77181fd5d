// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Labels of a person carried from pictures to other ones.
#include <utility>

#include "ui/label/label_flow.h"
#include "ui/label/label_session.h"

namespace poselift {

bool LabelSession::DoFlow(Action action) {
  switch (action) {
    case Action::kFollowAll:
      Follow(Reach::kAround);
      return true;
    case Action::kFollowForwards:
      Follow(Reach::kForwards);
      return true;
    case Action::kFollowBackwards:
      Follow(Reach::kBackwards);
      return true;
    case Action::kCopyFollowed:
      Follow([labels = labels(), dir = project_->dir(), ref = Ref(), &lifter = lifter_](
                 const ProgressFn&) { return FollowFromFrameBefore(labels, dir, ref, lifter); });
      return true;
    case Action::kPosesBetween:
      Follow([labels = labels(), ref = Ref(), &lifter = lifter_](const ProgressFn&) {
        return PosesBetween(labels, ref, lifter);
      });
      return true;
    case Action::kAccept:
      if (HasPerson()) Apply(AcceptGuess(labels(), Ref()));
      return true;
    case Action::kCopy:
      if (HasPerson()) clipboard_ = labels().frames[frame_index_].people[person_index_];
      return true;
    case Action::kPaste:
      if (clipboard_) Apply(PastePerson(labels(), Ref(), *clipboard_));
      return true;
    default:
      return false;
  }
}

// In the background, from the labels as they are now.
void LabelSession::Follow(BackgroundJob<GuessedLabels>::Work work) {
  if (!follow_job_.IsBusy() && !project_->read_only()) follow_job_.Start(std::move(work));
}

void LabelSession::Follow(Reach reach) {
  Follow(
      [labels = labels(), dir = project_->dir(), ref = Ref(), reach](const ProgressFn& progress) {
        return FollowPerson(labels, dir, ref, reach, progress);
      });
}

std::optional<double> LabelSession::FollowProgress() const {
  return follow_job_.IsBusy() ? std::optional(follow_job_.Fraction()) : std::nullopt;
}

bool LabelSession::TakeFollowed() {
  try {
    const auto guesses = follow_job_.Take();
    if (guesses) Apply(PutGuesses(labels(), *guesses));
    return guesses.has_value();
  } catch (const std::exception& error) {
    notice_ = error.what();
    return true;
  }
}

void LabelSession::WaitUntilFollowed() {
  follow_job_.WaitUntilIdle();
  TakeFollowed();
}

}  // namespace poselift
