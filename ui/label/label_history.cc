// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_history.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "src/input_error.h"
#include "src/io/labels_formats.h"
#include "src/layout.h"

namespace poselift {
namespace {

void CheckLandmark(const LandmarkLabel& landmark, const Layout& layout) {
  if (!layout.Find(landmark.name))
    throw InputError(fmt::format("found the landmark \"{}\", wanted one of the layout {}",
                                 landmark.name, layout.name));
  if (!(landmark.x_px.array().abs() <= kLargestCoordinate_px).all())  // NaN is none of them
    throw InputError(fmt::format("found {} at ({:g}, {:g}) px, wanted it within {:g} px",
                                 landmark.name, landmark.x_px.x(), landmark.x_px.y(),
                                 kLargestCoordinate_px));
  if (const auto radius = landmark.radius_px;
      radius && !(*radius > 0.0 && *radius <= kLargestCoordinate_px))
    throw InputError(
        fmt::format("found the radius {:g} px of {}, wanted one above 0", *radius, landmark.name));
}

void CheckPeople(const std::vector<PersonLabels>& people, const Layout& layout) {
  std::set<int> ids;
  for (const PersonLabels& person : people) {
    if (!ids.insert(person.id).second)
      throw InputError(fmt::format("found a second person with the id {}, wanted one", person.id));
    std::set<std::string_view> names;
    for (const LandmarkLabel& landmark : person.landmarks) {
      CheckLandmark(landmark, layout);
      if (!names.insert(landmark.name).second)
        throw InputError(fmt::format("found {} of a person twice, wanted it once", landmark.name));
    }
    for (size_t i = 0; i < person.hints.size(); ++i)
      if (const std::string error =
              WhatIsWrongWith(person.hints[i], std::span(person.hints).first(i), layout);
          !error.empty())
        throw InputError(error);
  }
}

void CheckTime(const FrameTime& time) {
  if (time.time_s && !(std::abs(*time.time_s) <= kLargestTime_s))
    throw InputError(fmt::format("found the time {:g} s, wanted one of a video", *time.time_s));
  if (time.frame && *time.frame < 0)
    throw InputError(fmt::format("found the frame {}, wanted 0 or more", *time.frame));
}

void CheckFrame(const FrameLabels& frame, const Layout& layout) {
  const auto within = [](int size_px) { return size_px >= 0 && size_px <= kLargestPicture_px; };
  if (!within(frame.width_px) || !within(frame.height_px) ||
      (frame.width_px > 0) != (frame.height_px > 0))
    throw InputError(fmt::format("found a picture of {} x {} px, wanted a size up to {} or 0 x 0",
                                 frame.width_px, frame.height_px, kLargestPicture_px));
  CheckTime(TimeOf(frame));
  CheckPeople(frame.people, layout);
}

template <typename Map>
void CheckFrameNumbers(const Map& map, size_t num_frames) {
  if (!map.empty() && map.rbegin()->first >= num_frames)
    throw InputError(fmt::format("found the frame {}, wanted one of the {} there are",
                                 map.rbegin()->first, num_frames));
}

template <typename Map>
bool HaveEqualKeys(const Map& a, const Map& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.first == y.first; });
}

}  // namespace

FrameTime TimeOf(const FrameLabels& frame) { return {frame.time_s, frame.frame}; }

void CheckEdit(const Labels& labels, const LabelEdit& edit) {
  const Layout* const layout = FindLayout(labels.layout);
  if (!layout) throw InputError(fmt::format("found no layout \"{}\"", labels.layout));
  if (edit.dropped > labels.frames.size())
    throw InputError(fmt::format("found {} frames to drop, wanted up to the {} there are",
                                 edit.dropped, labels.frames.size()));
  const size_t num_kept = labels.frames.size() - edit.dropped;
  CheckFrameNumbers(edit.people, num_kept);
  CheckFrameNumbers(edit.images, num_kept);
  CheckFrameNumbers(edit.times, num_kept);
  for (const auto& [frame, time] : edit.times) CheckTime(time);
  for (const auto& [frame, people] : edit.people) CheckPeople(people, *layout);
  for (const FrameLabels& frame : edit.added) CheckFrame(frame, *layout);
}

void ApplyEdit(const LabelEdit& edit, Labels* labels) {
  for (const auto& [frame, people] : edit.people) labels->frames[frame].people = people;
  for (const auto& [frame, image] : edit.images) labels->frames[frame].image = image;
  for (const auto& [frame, time] : edit.times) {
    labels->frames[frame].time_s = time.time_s;
    labels->frames[frame].frame = time.frame;
  }
  labels->frames.resize(labels->frames.size() - edit.dropped);
  labels->frames.insert(labels->frames.end(), edit.added.begin(), edit.added.end());
}

LabelEdit WayBack(const Labels& labels, const LabelEdit& edit) {
  LabelEdit before;
  for (const auto& [frame, people] : edit.people)
    before.people[frame] = labels.frames[frame].people;
  for (const auto& [frame, image] : edit.images) before.images[frame] = labels.frames[frame].image;
  for (const auto& [frame, time] : edit.times) before.times[frame] = TimeOf(labels.frames[frame]);
  before.added.assign(labels.frames.end() - static_cast<std::ptrdiff_t>(edit.dropped),
                      labels.frames.end());
  return before;
}

void RevertStep(const LabelStep& step, Labels* labels) {
  const size_t added = step.edit.added.size();
  if (added > labels->frames.size())
    throw InputError(fmt::format("found {} frames, wanted the {} that were added",
                                 labels->frames.size(), added));
  labels->frames.resize(labels->frames.size() - added);
  CheckEdit(*labels, step.before);
  ApplyEdit(step.before, labels);
}

bool LabelSteps::MergesWithLast(const LabelEdit& edit) const {
  if (sealed_ || edit.merge_key.empty() || applied_ == 0) return false;
  const LabelEdit& last = all_[applied_ - 1].edit;
  return last.merge_key == edit.merge_key && last.added.empty() && edit.added.empty() &&
         last.dropped == 0 && edit.dropped == 0 && HaveEqualKeys(last.people, edit.people) &&
         HaveEqualKeys(last.images, edit.images) && HaveEqualKeys(last.times, edit.times);
}

void LabelSteps::Push(LabelEdit edit, LabelEdit before) {
  all_.resize(applied_);
  if (MergesWithLast(edit)) {
    all_.back().edit = std::move(edit);
    all_.back().state = ++last_state_;
  } else {
    all_.push_back({std::move(edit), std::move(before), ++last_state_});
    ++applied_;
  }
  sealed_ = false;
}

void LabelSteps::Forget(size_t count) {
  count = std::min(count, applied_);
  if (count > 0) first_state_ = all_[count - 1].state;
  all_.erase(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(count));
  applied_ -= count;
  sealed_ = true;
}

bool LabelHistory::Apply(LabelEdit edit) {
  if (edit.ChangesNothing()) return false;
  CheckEdit(labels_, edit);
  LabelEdit before = WayBack(labels_, edit);
  ApplyEdit(edit, &labels_);
  steps_.Push(std::move(edit), std::move(before));
  return true;
}

bool LabelHistory::Undo() {
  if (!CanUndo()) return false;
  RevertStep(*steps_.back(), &labels_);
  steps_.Back();
  return true;
}

bool LabelHistory::Redo() {
  if (!CanRedo()) return false;
  ApplyEdit(steps_.forward()->edit, &labels_);
  steps_.Forward();
  return true;
}

}  // namespace poselift
