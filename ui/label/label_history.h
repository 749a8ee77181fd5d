// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/labels.h"

namespace poselift {

// When a frame is (FrameLabels), all of it.
struct FrameTime {
  std::optional<double> time_s;
  std::optional<int> frame;

  bool operator==(const FrameTime&) const = default;
};
FrameTime TimeOf(const FrameLabels& frame);

// A change of labels, said by what is there afterwards. One edit may touch many frames:
// labels carried through a video are one step back.
struct LabelEdit {
  std::string name;                                    // for a menu: "place left knee"
  std::map<size_t, std::vector<PersonLabels>> people;  // of these frames, all of them
  std::map<size_t, std::string> images;                // paths of pictures that moved
  std::vector<FrameLabels> added = {};                 // frames put behind the last one
  // An edit with the key of the one before it makes one step with it: small nudges of the same
  // landmark. Empty: a step of its own. An edit that adds or drops frames is always one.
  std::string merge_key = {};
  size_t dropped = 0;  // so many of the last frames go, before any are added
  std::map<size_t, FrameTime> times = {};

  bool ChangesNothing() const {
    return people.empty() && images.empty() && times.empty() && added.empty() && dropped == 0;
  }
};

// An edit and its way back: people, images and times as they were, and the frames that were
// dropped.
struct LabelStep {
  LabelEdit edit;
  LabelEdit before;         // without name, merge_key and dropped
  std::uint64_t state = 0;  // of the labels after it
};

// Throws InputError for what labels cannot hold (docs/FORMATS.md): frames that are not there, two
// people of one id, landmarks twice or of another layout, coordinates beyond 1e6 px, hints of
// what the body does not have.
void CheckEdit(const Labels& labels, const LabelEdit& edit);

// Not checked: CheckEdit.
void ApplyEdit(const LabelEdit& edit, Labels* labels);
LabelEdit WayBack(const Labels& labels, const LabelEdit& edit);

// Takes the step back. Throws InputError when the labels cannot have come from it.
void RevertStep(const LabelStep& step, Labels* labels);

// What was done, in order, and how much of it is in force; without the labels themselves.
class LabelSteps {
 public:
  // In force, and behind it the steps that were taken back. All of them.
  const std::vector<LabelStep>& all() const { return all_; }
  size_t applied() const { return applied_; }
  // The step that Back, or Forward, would take; null when there is none.
  const LabelStep* back() const { return applied_ > 0 ? &all_[applied_ - 1] : nullptr; }
  const LabelStep* forward() const { return applied_ < all_.size() ? &all_[applied_] : nullptr; }
  // 0 before the first step; no two states of the labels have the same number.
  std::uint64_t state() const { return back() ? back()->state : first_state_; }

  void Push(LabelEdit edit, LabelEdit before);  // what was taken back is gone then
  void Back() { --applied_, sealed_ = true; }
  void Forward() { ++applied_, sealed_ = true; }
  // Of the oldest steps, in force, so many: they cannot be taken back any more.
  void Forget(size_t count);
  void Seal() { sealed_ = true; }  // the next edit does not merge

 private:
  bool MergesWithLast(const LabelEdit& edit) const;

  std::vector<LabelStep> all_;
  size_t applied_ = 0;
  std::uint64_t first_state_ = 0, last_state_ = 0;
  bool sealed_ = true;
};

// Labels that can be changed and changed back, without limit.
class LabelHistory {
 public:
  explicit LabelHistory(Labels labels) : labels_(std::move(labels)) {}

  const Labels& labels() const { return labels_; }
  const LabelSteps& steps() const { return steps_; }

  // Throws InputError as CheckEdit; the labels are then as before. An edit that changes nothing
  // is no step: false.
  bool Apply(LabelEdit edit);
  // False when there is nothing to take back, or to do again.
  bool Undo();
  bool Redo();
  // The next edit is a step of its own.
  void Seal() { steps_.Seal(); }
  void Forget(size_t count) { steps_.Forget(count); }

  bool CanUndo() const { return steps_.back() != nullptr; }
  bool CanRedo() const { return steps_.forward() != nullptr; }
  // Empty when there is none.
  std::string_view UndoName() const {
    return CanUndo() ? steps_.back()->edit.name : std::string_view();
  }
  std::string_view RedoName() const {
    return CanRedo() ? steps_.forward()->edit.name : std::string_view();
  }
  // How many steps are in force, and a number that tells states of the labels apart.
  size_t NumSteps() const { return steps_.applied(); }
  std::uint64_t state() const { return steps_.state(); }

 private:
  Labels labels_;
  LabelSteps steps_;
};

}  // namespace poselift
