// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/key_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "src/translated.h"

namespace poselift {
namespace {

void CheckKeyFrames(const Labels& labels) {
  if (!AreKeyFrames(labels))
    throw std::invalid_argument("pictures have no key frames: poses without pictures do");
}

FrameTime TimeOf(const KeyTimes& times, size_t key) {
  const int number = times.numbers[key];
  return {.time_s = times.Time_s(number), .frame = number};
}

// What differs from the labels; frames beyond them are not looked at.
void PutTimes(const Labels& labels, const KeyTimes& times, LabelEdit* edit) {
  const size_t count = std::min(times.numbers.size(), labels.frames.size());
  for (size_t f = 0; f < count; ++f)
    if (TimeOf(times, f) != TimeOf(labels.frames[f])) edit->times[f] = TimeOf(times, f);
}

// Numbers that do not grow do, by what is wanting.
void MakeRoom(std::vector<int>* numbers) {
  for (size_t k = 1; k < numbers->size(); ++k)
    (*numbers)[k] = std::max((*numbers)[k], (*numbers)[k - 1] + 1);
}

}  // namespace

int NumberBehind(const KeyTimes& times, size_t key) {
  const int number = times.numbers.at(key);
  if (key + 1 == times.numbers.size()) return number + times.Gap();
  return std::max(number + 1, (number + times.numbers[key + 1]) / 2);
}

LabelEdit AddKeyFrame(const Labels& labels, const KeyTimes& times, int number,
                      std::vector<PersonLabels> people) {
  CheckKeyFrames(labels);
  const auto at =
      static_cast<size_t>(std::ranges::lower_bound(times.numbers, number) - times.numbers.begin());
  KeyTimes now = times;
  now.numbers.insert(now.numbers.begin() + static_cast<std::ptrdiff_t>(at), number);
  MakeRoom(&now.numbers);
  LabelEdit edit;
  edit.name = Translated("add key frame {}", at + 1);
  // Frames are put behind the last one: all from here on move up by one place.
  FrameLabels added = labels.frames.back();
  if (at == labels.frames.size()) {
    added.people = std::move(people);
  } else {
    edit.people[at] = std::move(people);
    for (size_t f = at + 1; f < labels.frames.size(); ++f)
      edit.people[f] = labels.frames[f - 1].people;
  }
  PutTimes(labels, now, &edit);
  const FrameTime last = TimeOf(now, now.numbers.size() - 1);
  added.time_s = last.time_s;
  added.frame = last.frame;
  edit.added = {std::move(added)};
  return edit;
}

LabelEdit RemoveKeyFrame(const Labels& labels, const KeyTimes& times, size_t key) {
  CheckKeyFrames(labels);
  if (labels.frames.size() < 2) throw std::invalid_argument(Translated("the last key frame stays"));
  KeyTimes now = times;
  now.numbers.erase(now.numbers.begin() + static_cast<std::ptrdiff_t>(key));
  LabelEdit edit;
  edit.name = Translated("remove key frame {}", key + 1);
  for (size_t f = key; f + 1 < labels.frames.size(); ++f)
    edit.people[f] = labels.frames.at(f + 1).people;
  PutTimes(labels, now, &edit);
  edit.dropped = 1;
  return edit;
}

LabelEdit MoveKeyFrame(const Labels& labels, KeyTimes times, size_t key, int number, Along along) {
  CheckKeyFrames(labels);
  std::vector<int>& numbers = times.numbers;
  const bool is_last = key + 1 == numbers.size();
  const int reach = numbers.back() - numbers.at(key);  // of those that go along
  const int least = key == 0 ? 0 : numbers[key - 1] + 1;
  int most = KeyTimes::kMostNumber;
  if (along == Along::kAllBehind) most -= reach;
  if (along == Along::kAlone && !is_last) most = numbers[key + 1] - 1;
  const int by = std::max(least, std::min(number, most)) - numbers[key];
  for (size_t k = key; k < numbers.size(); ++k)
    if (k == key || along == Along::kAllBehind) numbers[k] += by;
  LabelEdit edit;
  edit.name = Translated("move key frame {}", key + 1);
  edit.merge_key = edit.name;
  if (by != 0) PutTimes(labels, times, &edit);
  return edit;
}

LabelEdit ChangeKeyRate(const Labels& labels, const KeyTimes& times, double fps) {
  CheckKeyFrames(labels);
  KeyTimes now{.fps = fps, .numbers = times.numbers};
  for (int& number : now.numbers)
    number = static_cast<int>(std::lround(times.Time_s(number) * fps));
  MakeRoom(&now.numbers);
  LabelEdit edit;
  edit.name = Translated("{:g} frames a second", fps);
  edit.merge_key = "frames a second";
  PutTimes(labels, now, &edit);
  return edit;
}

}  // namespace poselift
