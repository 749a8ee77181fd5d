// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Labels of a person carried from pictures to other ones.
#include <utility>

#include "src/input_error.h"
#include "ui/label/label_flow.h"
#include "ui/label/label_session.h"

namespace poselift {

bool LabelSession::DoFlow(Action action) {
  try {
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
      case Action::kStop:
        if (follow_) follow_->Stop();
        return true;
      case Action::kCopyFollowed:
        Apply(PutGuesses(labels(), FollowFromFrameBefore(labels(), project_->dir(), Ref(), lifter_),
                         true));
        return true;
      case Action::kPosesBetween:
        Apply(PutGuesses(labels(), PosesBetween(labels(), Ref(), lifter_)));
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
  } catch (const InputError& error) {
    notice_ = error.what();
    return true;
  }
}

// In the background, from the labels as they are now.
void LabelSession::Follow(Reach reach) {
  if (follow_ || project_->read_only()) return;
  follow_ = std::make_unique<BackgroundJob<GuessedLabels>>(
      [labels = labels(), dir = project_->dir(), ref = Ref(), reach](const ProgressFn& progress) {
        return FollowPerson(labels, dir, ref, reach, progress);
      },
      wake_);
}

std::optional<double> LabelSession::FollowProgress() const {
  return follow_ ? std::optional(follow_->fraction()) : std::nullopt;
}

bool LabelSession::TakeFollowed() {
  if (!follow_ || !follow_->is_done()) return false;
  const auto done = std::exchange(follow_, nullptr);
  if (done->result())
    Apply(PutGuesses(labels(), *done->result()));
  else
    notice_ = done->error().empty() ? "stopped: no labels were changed" : done->error();
  return true;
}

void LabelSession::WaitUntilFollowed() {
  while (follow_) {
    TakeFollowed();
    std::this_thread::yield();
  }
}

}  // namespace poselift
