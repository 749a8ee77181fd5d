// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Key frames in time, and the motion between them.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "src/translated.h"
#include "ui/label/label_session.h"

namespace poselift {

// The rate that a person chose counts as long as no key frame tells it.
KeyTimes LabelSession::Keys() const { return KeyTimesOf(labels(), key_fps_); }

int LabelSession::Number() const { return between_ ? *between_ : Keys().numbers[frame_index_]; }

void LabelSession::GoToNumber(int number) {
  const KeyTimes keys = Keys();
  number = std::clamp(number, 0, KeyTimes::kMostNumber);
  const size_t key = keys.KeyAt(number);
  if (key != frame_index_ || !is_playing_) GoToFrame(key);
  // Who plays sees the motion at key frames too.
  if (keys.numbers[key] != number || is_playing_) between_ = number;
}

size_t LabelSession::NumMotionFrames() const {
  if (!HasKeyFrames()) return labels().frames.size();
  const KeyTimes keys = Keys();
  return static_cast<size_t>(keys.numbers.back() - keys.numbers.front()) + 1;
}

size_t LabelSession::MotionFrame() const {
  if (!HasKeyFrames()) return frame_index_;
  const KeyTimes keys = Keys();
  return static_cast<size_t>(std::clamp(Number(), keys.numbers.front(), keys.numbers.back()) -
                             keys.numbers.front());
}

void LabelSession::GoToMotionFrame(size_t frame) {
  if (!HasKeyFrames()) return GoToFrame(frame);
  GoToNumber(Keys().numbers.front() + static_cast<int>(frame));
}

Playback LabelSession::PlaybackFrom(size_t motion_frame) const {
  if (!HasKeyFrames()) return {labels(), motion_frame};
  return {NumMotionFrames(), Keys().Time_s(1), motion_frame};
}

void LabelSession::LabelsChanged() {
  between_.reset();
  if (HasKeyFrames() && labels().frames.size() > 1 && !IsMotionCurrent())
    DoMotion(Action::kSmoothMotion);
}

bool LabelSession::DoKeys(Action action) {
  try {
    switch (action) {
      case Action::kAddKeyFrame:
        AddKey();
        return true;
      case Action::kPosesBetween:
        if (!HasKeyFrames()) return false;
        notice_ = Translated("the poses between key frames are there: play them");
        return true;
      case Action::kRemoveFrame:
        CheckIsKey();
        Apply(RemoveKeyFrame(labels(), Keys(), frame_index_));
        GoToFrame(frame_index_);
        return true;
      case Action::kKeyEarlier:
      case Action::kKeyLater:
        CheckIsKey();
        MoveKey(frame_index_, Keys().numbers[frame_index_] + (action == Action::kKeyLater ? 1 : -1),
                Along::kAlone);
        return true;
      case Action::kStepForward:
        GoToMotionFrame(std::min(MotionFrame() + 1, NumMotionFrames() - 1));
        return true;
      case Action::kStepBack:
        GoToMotionFrame(std::max<size_t>(MotionFrame(), 1) - 1);
        return true;
      default:
        return false;
    }
  } catch (const std::invalid_argument& error) {
    notice_ = error.what();
    return true;
  }
}

void LabelSession::CheckIsKey() const {
  if (between_) throw std::invalid_argument(Translated("this is no key frame: go to one first"));
}

// Between key frames, as the motion is there; on one, as that is.
std::vector<PersonLabels> LabelSession::PeopleHere() const {
  std::vector<PersonLabels> people = labels().frames[frame_index_].people;
  const LiftedPose* const here = MotionPose();
  if (!here || !HasPerson()) return people;
  PersonLabels& person = people[person_index_];
  std::vector<LabelHint> firm;  // on both sides: it stays put
  const size_t next = std::min(frame_index_ + 1, labels().frames.size() - 1);
  const PersonLabels* const behind = FindPerson(labels(), {next, person.id});
  for (const PoseHandle& handle : handles_) {
    const auto pins = [&](const LabelHint& hint) {
      return IsFirmPin(hint) && hint.joint == handle.name;
    };
    if (std::ranges::any_of(person.hints, pins) && behind &&
        std::ranges::any_of(behind->hints, pins))
      firm.push_back(FirmPin(handle, here->joints_in_cam_m, here->size));
  }
  std::erase_if(person.hints,
                [](const LabelHint& hint) { return IsFirmPin(hint) || IsSoftPin(hint); });
  const auto soft = SoftPins(handles_, firm, here->joints_in_cam_m, here->size);
  person.hints.insert(person.hints.end(), soft.begin(), soft.end());
  person.hints.insert(person.hints.end(), firm.begin(), firm.end());
  person.landmarks.clear();
  return people;
}

void LabelSession::AddKey() {
  if (between_) GoToNumber(*between_);  // which may be at a key frame, where playing stopped
  const KeyTimes keys = Keys();
  const int number = between_ ? *between_ : NumberBehind(keys, frame_index_);
  const size_t before = labels().frames.size();
  Apply(AddKeyFrame(labels(), keys, number, PeopleHere()));
  if (labels().frames.size() != before) GoToNumber(number);
}

void LabelSession::MoveKey(size_t key, int number, Along along) {
  Apply(MoveKeyFrame(labels(), Keys(), key, number, along));
  GoToFrame(key);
}

void LabelSession::ChangeRate(double fps) {
  key_fps_ = fps;
  Apply(ChangeKeyRate(labels(), Keys(), fps));
}

std::string LabelSession::KeyStatus() const {
  const KeyTimes keys = Keys();
  const int number = Number();
  const std::string when = Translated("frame {}, {:.2f} s", number, keys.Time_s(number));
  if (!between_)
    return Translated("key frame {} of {}, {}", frame_index_ + 1, keys.numbers.size(), when);
  const std::string where = number < keys.numbers.front() ? Translated("before the first key frame")
                            : number > keys.numbers.back() ? Translated("behind the last key frame")
                                                           : Translated("between key frames");
  return Translated("{}, {}   a key frame that is added here is this pose", when, where);
}

}  // namespace poselift
