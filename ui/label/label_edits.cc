// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_edits.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "src/joints.h"
#include "src/layout.h"
#include "src/translated.h"
#include "ui/label/in_words.h"

namespace poselift {
namespace {

constexpr std::string_view kStateNames[] = {"visible", "occluded", "absent"};

template <typename People>
auto Find(People& people, int id) {
  return std::find_if(people.begin(), people.end(), [&](const auto& p) { return p.id == id; });
}

template <typename Landmarks>
auto FindNamed(Landmarks& landmarks, std::string_view name) {
  return std::find_if(landmarks.begin(), landmarks.end(),
                      [&](const auto& landmark) { return landmark.name == name; });
}

const PersonLabels& PersonAt(const Labels& labels, PersonRef ref) {
  if (const PersonLabels* person = FindPerson(labels, ref)) return *person;
  throw std::invalid_argument(fmt::format("no person {} in frame {}", ref.id, ref.frame));
}

const LandmarkLabel& LandmarkAt(const Labels& labels, PersonRef ref, std::string_view landmark) {
  if (const LandmarkLabel* found = FindLandmark(labels, ref, landmark)) return *found;
  throw std::invalid_argument(fmt::format("person {} has no {}", ref.id, landmark));
}

// The frame's people, with this one in its place or behind the others.
LabelEdit WithPerson(const Labels& labels, size_t frame, PersonLabels person, std::string name) {
  std::vector<PersonLabels> people = labels.frames.at(frame).people;
  person.is_propagated = false;  // somebody looked at it
  if (const auto found = Find(people, person.id); found != people.end())
    *found = std::move(person);
  else
    people.push_back(std::move(person));
  LabelEdit edit;
  edit.name = std::move(name);
  edit.people[frame] = std::move(people);
  return edit;
}

LabelEdit WithLandmark(const Labels& labels, PersonRef ref, LandmarkLabel landmark,
                       std::string name) {
  PersonLabels person{ref.id, {}};
  if (const PersonLabels* found = FindPerson(labels, ref)) person = *found;
  if (const auto found = FindNamed(person.landmarks, landmark.name);
      found != person.landmarks.end())
    *found = std::move(landmark);
  else
    person.landmarks.push_back(std::move(landmark));
  return WithPerson(labels, ref.frame, std::move(person), std::move(name));
}

// "left_knee" for "right_knee"; itself when neither the layout nor the body has another side of it.
std::string OtherSide(const Layout& layout, const std::string& name) {
  constexpr std::string_view kLeft = "left_", kRight = "right_";
  std::string other = name;
  if (name.starts_with(kLeft))
    other.replace(0, kLeft.size(), kRight);
  else if (name.starts_with(kRight))
    other.replace(0, kRight.size(), kLeft);
  return layout.Find(other) || FindJoint(other) ? other : name;
}

void SwapSidesOf(const Layout& layout, PersonLabels* person) {
  for (LandmarkLabel& landmark : person->landmarks)
    landmark.name = OtherSide(layout, landmark.name);
  for (LabelHint& hint : person->hints) {
    hint.joint = OtherSide(layout, hint.joint);
    hint.other = OtherSide(layout, hint.other);
  }
}

bool IsOfBone(const LabelHint& hint) {
  return hint.kind == LabelHint::Kind::kTowardsCamera ||
         hint.kind == LabelHint::Kind::kAwayFromCamera;
}

// Whether a new hint takes the other's place.
bool AreOfTheSame(const LabelHint& a, const LabelHint& b) {
  if (IsOfBone(a) && IsOfBone(b)) return a.joint == b.joint;
  if (a.kind != b.kind) return false;
  const bool are_the_other_way_round = a.joint == b.other && a.other == b.joint;
  return (a.joint == b.joint && a.other == b.other) ||
         (a.kind == LabelHint::Kind::kNearer && are_the_other_way_round);
}

const Layout& LayoutOf(const Labels& labels) {
  if (const Layout* layout = FindLayout(labels.layout)) return *layout;
  throw std::invalid_argument("no layout " + labels.layout);
}

LabelEdit TransformPerson(const Labels& labels, PersonRef ref, const Eigen::Affine2d& new_from_old,
                          double radius_factor, const std::string& name) {
  PersonLabels person = PersonAt(labels, ref);
  if (new_from_old.matrix() == Eigen::Affine2d::Identity().matrix()) return {.name = name};
  for (LandmarkLabel& landmark : person.landmarks) {
    landmark.x_px = new_from_old * landmark.x_px;
    if (landmark.radius_px) *landmark.radius_px *= radius_factor;
  }
  return WithPerson(labels, ref.frame, std::move(person), name);
}

template <typename Linear>
Eigen::Affine2d AboutCenter(const PersonLabels& person, const Linear& linear) {
  const Eigen::Vector2d center_px = PersonCenter(person);
  return Eigen::Translation2d(center_px) * linear * Eigen::Translation2d(-center_px);
}

}  // namespace

const PersonLabels* FindPerson(const Labels& labels, PersonRef ref) {
  const std::vector<PersonLabels>& people = labels.frames.at(ref.frame).people;
  const auto found = Find(people, ref.id);
  return found == people.end() ? nullptr : &*found;
}

const LandmarkLabel* FindLandmark(const Labels& labels, PersonRef ref, std::string_view landmark) {
  const PersonLabels* person = FindPerson(labels, ref);
  if (!person) return nullptr;
  const auto found = FindNamed(person->landmarks, landmark);
  return found == person->landmarks.end() ? nullptr : &*found;
}

LabelEdit PlaceLandmark(const Labels& labels, PersonRef ref, std::string_view landmark,
                        const Eigen::Vector2d& x_px, LabelState state) {
  if (!LayoutOf(labels).Find(landmark))
    throw std::invalid_argument(fmt::format("no {} in the layout {}", landmark, labels.layout));
  return WithLandmark(labels, ref, {std::string(landmark), x_px, state, std::nullopt},
                      Translated("place {}", InWords(landmark)));
}

LabelEdit MoveLandmark(const Labels& labels, PersonRef ref, std::string_view landmark,
                       const Eigen::Vector2d& x_px) {
  LandmarkLabel moved = LandmarkAt(labels, ref, landmark);
  moved.x_px = x_px;
  if (moved.state == LabelState::kAbsent) moved.state = LabelState::kVisible;
  moved.radius_px.reset();
  return WithLandmark(labels, ref, std::move(moved), Translated("move {}", InWords(landmark)));
}

LabelEdit NudgeLandmark(const Labels& labels, PersonRef ref, std::string_view landmark,
                        const Eigen::Vector2d& step_px) {
  LandmarkLabel nudged = LandmarkAt(labels, ref, landmark);
  nudged.x_px += step_px;
  if (nudged.state == LabelState::kAbsent) nudged.state = LabelState::kVisible;
  nudged.radius_px.reset();
  LabelEdit edit =
      WithLandmark(labels, ref, std::move(nudged), Translated("nudge {}", InWords(landmark)));
  edit.merge_key = fmt::format("nudge {} of {} in {}", landmark, ref.id, ref.frame);
  return edit;
}

LabelEdit SetLandmarkState(const Labels& labels, PersonRef ref, std::string_view landmark,
                           LabelState state) {
  LandmarkLabel changed = LandmarkAt(labels, ref, landmark);
  changed.state = state;
  return WithLandmark(labels, ref, std::move(changed),
                      Translated("mark {} as {}", InWords(landmark),
                                 Translated(std::string(kStateNames[static_cast<int>(state)]))));
}

LabelEdit CycleLandmarkState(const Labels& labels, PersonRef ref, std::string_view landmark) {
  const int state = static_cast<int>(LandmarkAt(labels, ref, landmark).state);
  return SetLandmarkState(labels, ref, landmark, static_cast<LabelState>((state + 1) % 3));
}

LabelEdit RemoveLandmark(const Labels& labels, PersonRef ref, std::string_view landmark) {
  LandmarkAt(labels, ref, landmark);
  PersonLabels person = PersonAt(labels, ref);
  person.landmarks.erase(FindNamed(person.landmarks, landmark));
  return WithPerson(labels, ref.frame, std::move(person),
                    Translated("remove {}", InWords(landmark)));
}

LabelEdit AddPerson(const Labels& labels, PersonRef ref) {
  if (FindPerson(labels, ref))
    throw std::invalid_argument(fmt::format("person {} is in frame {}", ref.id, ref.frame));
  return WithPerson(labels, ref.frame, {ref.id, {}}, Translated("add person {}", ref.id));
}

LabelEdit RemovePerson(const Labels& labels, PersonRef ref) {
  PersonAt(labels, ref);
  LabelEdit edit;
  edit.name = Translated("remove person {}", ref.id);
  std::vector<PersonLabels>& people = edit.people[ref.frame];
  people = labels.frames.at(ref.frame).people;
  people.erase(Find(people, ref.id));
  return edit;
}

int FreePersonId(const Labels& labels, size_t frame) {
  int id = 0;
  while (FindPerson(labels, {frame, id})) ++id;
  return id;
}

LabelEdit GiveHints(const Labels& labels, PersonRef ref, const std::vector<LabelHint>& hints) {
  PersonLabels person = PersonAt(labels, ref);
  for (const LabelHint& hint : hints) {
    std::erase_if(person.hints, [&](const LabelHint& old) { return AreOfTheSame(old, hint); });
    person.hints.push_back(hint);
  }
  return WithPerson(labels, ref.frame, std::move(person),
                    hints.size() == 1 ? Translated("hint: {}", InWords(hints[0]))
                                      : Translated("{} hints", hints.size()));
}

LabelEdit RemoveHint(const Labels& labels, PersonRef ref, size_t index) {
  PersonLabels person = PersonAt(labels, ref);
  std::string name = Translated("forget: {}", InWords(person.hints.at(index)));
  person.hints.erase(person.hints.begin() + static_cast<std::ptrdiff_t>(index));
  return WithPerson(labels, ref.frame, std::move(person), std::move(name));
}

LabelEdit RemoveHints(const Labels& labels, PersonRef ref) {
  PersonLabels person = PersonAt(labels, ref);
  person.hints.clear();
  return WithPerson(labels, ref.frame, std::move(person),
                    Translated("forget the hints of person {}", ref.id));
}

LabelEdit SwapSides(const Labels& labels, PersonRef ref) {
  PersonLabels person = PersonAt(labels, ref);
  SwapSidesOf(LayoutOf(labels), &person);
  return WithPerson(labels, ref.frame, std::move(person),
                    Translated("swap left and right of person {}", ref.id));
}

LabelEdit MirrorFrame(const Labels& labels, size_t frame, int width_px) {
  if (width_px < 1) throw std::invalid_argument("a picture to mirror has a width");
  LabelEdit edit;
  edit.name = Translated("mirror labels");
  edit.people[frame] = labels.frames.at(frame).people;
  for (PersonLabels& person : edit.people[frame]) {
    SwapSidesOf(LayoutOf(labels), &person);
    for (LandmarkLabel& landmark : person.landmarks)
      landmark.x_px.x() = width_px - 1 - landmark.x_px.x();
    for (LabelHint& hint : person.hints) hint.x_in_cam_m.x() *= -1.0;
  }
  return edit;
}

LabelEdit MovePerson(const Labels& labels, PersonRef ref, const Eigen::Vector2d& step_px) {
  return TransformPerson(labels, ref, Eigen::Affine2d(Eigen::Translation2d(step_px)), 1.0,
                         Translated("move person {}", ref.id));
}

LabelEdit RotatePerson(const Labels& labels, PersonRef ref, double angle_rad) {
  const auto turn = AboutCenter(PersonAt(labels, ref), Eigen::Rotation2Dd(angle_rad));
  LabelEdit edit = TransformPerson(labels, ref, turn, 1.0, Translated("turn person {}", ref.id));
  edit.merge_key = fmt::format("turn {} in {}", ref.id, ref.frame);
  return edit;
}

LabelEdit ScalePerson(const Labels& labels, PersonRef ref, double factor) {
  if (!(factor > 0.0)) throw std::invalid_argument("a person is scaled by a factor above 0");
  const auto scale = AboutCenter(PersonAt(labels, ref), Eigen::UniformScaling<double>(factor));
  LabelEdit edit =
      TransformPerson(labels, ref, scale, factor, Translated("scale person {}", ref.id));
  edit.merge_key = fmt::format("scale {} in {}", ref.id, ref.frame);
  return edit;
}

Eigen::Vector2d PersonCenter(const PersonLabels& person) {
  Eigen::AlignedBox2d seen_px, all_px;
  for (const LandmarkLabel& landmark : person.landmarks) {
    all_px.extend(landmark.x_px);
    if (landmark.state != LabelState::kAbsent) seen_px.extend(landmark.x_px);
  }
  if (all_px.isEmpty()) return Eigen::Vector2d::Zero();
  return seen_px.isEmpty() ? all_px.center() : seen_px.center();
}

LabelEdit CopyPerson(const Labels& labels, PersonRef from, size_t to_frame) {
  return WithPerson(labels, to_frame, PersonAt(labels, from),
                    Translated("copy person {} from frame {}", from.id, from.frame + 1));
}

LabelEdit PastePerson(const Labels& labels, PersonRef to, PersonLabels person) {
  person.id = to.id;
  return WithPerson(labels, to.frame, std::move(person), Translated("paste person {}", to.id));
}

}  // namespace poselift
