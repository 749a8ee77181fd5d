// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/random_labels.h"

#include <fmt/core.h>

#include "src/io/labels_formats.h"
#include "src/layout.h"
#include "ui/label/journal_line.h"
#include "ui/label/label_edits.h"

namespace poselift::testing {
namespace {

int Below(int count, std::mt19937* rng) {
  return static_cast<int>((*rng)() % static_cast<unsigned>(count));
}

Eigen::Vector2d RandomPlace_px(std::mt19937* rng) {
  std::uniform_real_distribution<double> coordinate_px(-20.0, 700.0);
  const double x_px = coordinate_px(*rng);
  return {x_px, coordinate_px(*rng)};
}

std::string RandomLandmark(const Labels& labels, std::mt19937* rng) {
  const auto& landmarks = FindLayout(labels.layout)->landmarks;
  return std::string(landmarks[static_cast<size_t>(Below(std::ssize(landmarks), rng))].name);
}

LabelEdit EditOfLandmark(const Labels& labels, PersonRef ref, std::mt19937* rng) {
  const PersonLabels* person = FindPerson(labels, ref);
  if (!person || person->landmarks.empty() || Below(3, rng) == 0)
    return PlaceLandmark(labels, ref, RandomLandmark(labels, rng), RandomPlace_px(rng));
  const auto index = static_cast<size_t>(Below(std::ssize(person->landmarks), rng));
  const std::string landmark = person->landmarks[index].name;
  switch (Below(4, rng)) {
    case 0:
      return MoveLandmark(labels, ref, landmark, RandomPlace_px(rng));
    case 1:
      return CycleLandmarkState(labels, ref, landmark);
    case 2:
      return RemoveLandmark(labels, ref, landmark);
    default:  // the first one, so that nudges meet
      return NudgeLandmark(labels, ref, person->landmarks[0].name, {0.25, -1.0});
  }
}

LabelHint RandomHint(const Labels& labels, std::mt19937* rng) {
  using Kind = LabelHint::Kind;
  switch (Below(6, rng)) {
    case 0:
      return {Kind::kNearer, "left_wrist", "right_wrist", 0.1};
    case 1:
      return {Kind::kNearer, "right_wrist", "left_wrist"};
    case 2:
      return {Kind::kTowardsCamera, "left_knee"};
    case 3:
      return {Kind::kOnFloor, RandomLandmark(labels, rng)};
    case 4:
      return {Kind::kHeight, "", "", 1.5 + 0.01 * Below(50, rng)};
    default:
      return {Kind::kPin,
              "right_hand",
              "",
              Below(2, rng) == 0 ? std::optional<double>(0.05) : std::optional<double>(),
              {0.25, -0.5, 0.001 * Below(1000, rng)}};
  }
}

LabelEdit EditOfHints(const Labels& labels, PersonRef ref, std::mt19937* rng) {
  const int count = static_cast<int>(std::ssize(FindPerson(labels, ref)->hints));
  if (count > 0 && Below(3, rng) == 0)
    return RemoveHint(labels, ref, static_cast<size_t>(Below(count, rng)));
  std::vector<LabelHint> hints = {RandomHint(labels, rng)};
  if (Below(2, rng) == 0) hints.push_back(RandomHint(labels, rng));
  return GiveHints(labels, ref, hints);
}

LabelEdit EditOfPerson(const Labels& labels, PersonRef ref, std::mt19937* rng) {
  if (!FindPerson(labels, ref)) return AddPerson(labels, ref);
  switch (Below(9, rng)) {
    case 0:
      return RemovePerson(labels, ref);
    case 1:
      return SwapSides(labels, ref);
    case 2:
      return MovePerson(labels, ref, {3.5, -2.0});
    case 3:
      return RotatePerson(labels, ref, 0.1);
    case 4:
      return ScalePerson(labels, ref, 1.1);
    case 5:
    case 6:
    case 7:
      return EditOfHints(labels, ref, rng);
    default:
      return CopyPerson(labels, ref, static_cast<size_t>(Below(std::ssize(labels.frames), rng)));
  }
}

LabelEdit EditOfFrames(const Labels& labels, PersonRef ref, std::mt19937* rng) {
  LabelEdit edit;
  const int kind = Below(5, rng);
  if (kind == 4 && labels.frames.size() > 1) {
    edit.name = "drop the last frame";
    edit.people[0] = labels.frames.back().people;
    edit.dropped = 1;
    return edit;
  }
  if (kind == 0) return MirrorFrame(labels, ref.frame, 640);
  if (kind == 1) {
    edit.name = "carry through the video";
    for (size_t i = 0; i < labels.frames.size(); ++i)
      edit.people[i] = labels.frames[ref.frame].people;
  } else if (kind == 2) {
    edit.name = "look for pictures";
    edit.images[ref.frame] = fmt::format("neu/\"{}\" \u00e4.jpg", Below(100, rng));
  } else {
    edit.name = "add a frame";
    edit.added.push_back(labels.frames[ref.frame]);
    edit.added.back().time_s = 0.1 * Below(100, rng);
  }
  return edit;
}

}  // namespace

Labels SomeLabels() {
  Labels labels{"body15", {}};
  for (int i = 0; i < 6; ++i) {
    labels.frames.push_back({fmt::format("pictures/{}.jpg", i), 640, 480, {}, {}, {}});
    if (i == 2) labels.frames.back().time_s = 0.1;
    if (i == 3) labels.frames.back().frame = 7;
  }
  std::mt19937 rng(5);
  for (int id : {0, 4})
    for (LabelState state : {LabelState::kVisible, LabelState::kOccluded, LabelState::kAbsent})
      ApplyEdit(
          PlaceLandmark(
              labels, {1, id}, RandomLandmark(labels, &rng),
              state == LabelState::kAbsent ? Eigen::Vector2d::Zero() : RandomPlace_px(&rng), state),
          &labels);
  labels.frames[1].people[0].landmarks[0].radius_px = 2.5;
  return labels;
}

LabelEdit RandomEdit(const Labels& labels, std::mt19937* rng) {
  const PersonRef ref{static_cast<size_t>(Below(std::ssize(labels.frames), rng)), Below(2, rng)};
  const int kind = Below(10, rng);
  if (kind < 6) return EditOfLandmark(labels, ref, rng);
  if (kind < 9) return EditOfPerson(labels, ref, rng);
  return EditOfFrames(labels, ref, rng);
}

std::string ExactText(const Labels& labels) {
  std::string text = labels.layout + "\n";
  for (const FrameLabels& frame : labels.frames) {
    AppendNativeFrame(frame, &text);
    text += "\n";
  }
  return text;
}

std::string ExactText(const LabelHistory& history) {
  std::string text = ExactText(history.labels());
  for (const LabelStep& step : history.steps().all()) text += EditLine(step.edit, step.before);
  return text + fmt::format("{} in force\n", history.NumSteps());
}

}  // namespace poselift::testing
