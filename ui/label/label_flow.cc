// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/frame_source.h"
#include "src/label_propagation.h"
#include "src/pose_between.h"
#include "src/translated.h"
#include "ui/label/frame_pictures.h"

namespace poselift {
namespace {

constexpr double kStillsRate_hz = 30.0;

struct FrameRange {
  size_t first = 0, end = 0;
};

double Time_s(const Labels& labels, size_t frame) {
  return labels.frames[frame].time_s.value_or(static_cast<double>(frame) / kStillsRate_hz);
}

bool GoTogether(const FrameLabels& a, const FrameLabels& b) {
  if (a.frame.has_value() != b.frame.has_value() || a.time_s.has_value() != b.time_s.has_value())
    return false;
  if (a.frame) return a.image == b.image;
  return a.width_px == b.width_px && a.height_px == b.height_px;
}

FrameRange FramesAround(const Labels& labels, size_t frame) {
  const auto& frames = labels.frames;
  FrameRange range{frame, frame + 1};
  while (range.first > 0 && GoTogether(frames[range.first - 1], frames[frame])) --range.first;
  while (range.end < frames.size() && GoTogether(frames[range.end], frames[frame])) ++range.end;
  return range;
}

// The pictures of a range of frames, counted from its first.
class RangeSource : public FrameSource {
 public:
  RangeSource(const Labels& labels, const std::filesystem::path& dir, FrameRange range)
      : labels_(labels), pictures_(dir), range_(range), next_(range.first) {}

  cv::Size size_px() const override {
    const FrameLabels& frame = labels_.frames[range_.first];
    return {frame.width_px, frame.height_px};
  }
  std::optional<VideoFrame> Next() override {
    if (next_ == range_.end) return std::nullopt;
    VideoFrame frame{.index = static_cast<int>(next_ - range_.first),
                     .time_s = Time_s(labels_, next_)};
    frame.bgr = pictures_.Read(labels_.frames[next_]);
    if (frame.bgr.empty())
      throw InputError(
          fmt::format("found no picture {}, wanted one to follow labels through", next_ + 1));
    ++next_;
    return frame;
  }
  std::optional<double> Skip_s() override {
    if (next_ == range_.end) return std::nullopt;
    return Time_s(labels_, next_++);
  }

 private:
  const Labels& labels_;
  FramePictures pictures_;
  FrameRange range_;
  size_t next_;
};

std::vector<size_t> KeyFramesFor(const Labels& labels, PersonRef ref, Reach reach) {
  std::vector<size_t> keys;
  if (reach == Reach::kAround) {
    const FrameRange range = FramesAround(labels, ref.frame);
    for (size_t f = range.first; f < range.end; ++f)
      if (IsKeyFrame(labels, {f, ref.id})) keys.push_back(f);
  } else if (IsKeyFrame(labels, ref)) {
    keys.push_back(ref.frame);
    const int step = reach == Reach::kForwards ? 1 : -1;
    if (const auto next = NextKeyFrame(labels, ref, step)) keys.push_back(*next);
    std::ranges::sort(keys);
  }
  return keys;
}

// Of the range the frames that labels at the keys can lead to.
FrameRange Reached(const Labels& labels, FrameRange range, const std::vector<size_t>& keys,
                   Reach reach, size_t at) {
  const double longest_s = PropagationOptions().max_gap_s;
  const auto is_beyond = [&](size_t frame, size_t key) {
    return std::abs(Time_s(labels, frame) - Time_s(labels, key)) > longest_s;
  };
  while (is_beyond(range.first, keys.front())) ++range.first;
  while (is_beyond(range.end - 1, keys.back())) --range.end;
  const bool is_bounded = keys.size() == 2;
  if (reach == Reach::kForwards) return {at, is_bounded ? keys.back() + 1 : range.end};
  if (reach == Reach::kBackwards) return {is_bounded ? keys.front() : range.first, at + 1};
  return range;
}

Labels OfPerson(const Labels& labels, int id, const std::vector<size_t>& frames, size_t first) {
  Labels keys{.layout = labels.layout};
  for (const size_t f : frames) {
    FrameLabels key = labels.frames[f];
    key.people = {*FindPerson(labels, {f, id})};
    key.frame = static_cast<int>(f - first);
    key.time_s = Time_s(labels, f);
    keys.frames.push_back(std::move(key));
  }
  return keys;
}

// Lifted as its labels alone say it.
LiftedPose PoseOf(const Labels& labels, PersonRef ref, const PhotoLifter& lifter) {
  LiftResult result =
      lifter.LiftPhoto(Observe(*FindPerson(labels, ref), *FindLayout(labels.layout)));
  if (!result.IsUsable())
    throw InputError(fmt::format("the person of picture {} cannot be lifted: {}", ref.frame + 1,
                                 result.message));
  return std::move(result.poses.front());
}

// All landmarks of the layout, as a camera sees them.
PersonLabels SeenBy(const WeakCamera& camera, const Pose3& joints_in_cam_m, const Layout& layout,
                    int id) {
  PersonLabels person{.id = id};
  for (const Landmark& landmark : layout.landmarks)
    if (!landmark.parts.empty())
      person.landmarks.push_back(
          {std::string(landmark.name),
           camera.scale_px_per_m * SumOfJoints(landmark.parts, joints_in_cam_m).head<2>() +
               camera.translation_px,
           LabelState::kOccluded, std::nullopt});
  return person;
}

}  // namespace

bool IsKeyFrame(const Labels& labels, PersonRef ref) {
  const PersonLabels* const person = FindPerson(labels, ref);
  return person && !person->is_propagated && !person->landmarks.empty();
}

std::optional<size_t> NextKeyFrame(const Labels& labels, PersonRef ref, int step) {
  const FrameRange range = FramesAround(labels, ref.frame);
  const auto last = static_cast<std::ptrdiff_t>(range.end) - 1;
  for (auto f = static_cast<std::ptrdiff_t>(ref.frame) + step;
       f >= static_cast<std::ptrdiff_t>(range.first) && f <= last; f += step)
    if (IsKeyFrame(labels, {static_cast<size_t>(f), ref.id})) return static_cast<size_t>(f);
  return std::nullopt;
}

GuessedLabels FollowPerson(const Labels& labels, const std::filesystem::path& dir, PersonRef ref,
                           Reach reach, const ProgressFn& progress) {
  const std::vector<size_t> keys = KeyFramesFor(labels, ref, reach);
  if (keys.empty())
    throw InputError(reach == Reach::kAround
                         ? "found no labels that a person placed, wanted some to follow"
                         : "found no labels that a person placed in this picture, wanted some to "
                           "follow");
  const FrameRange range = Reached(labels, FramesAround(labels, ref.frame), keys, reach, ref.frame);
  RangeSource source(labels, dir, range);
  const Labels followed =
      PropagateLabels(OfPerson(labels, ref.id, keys, range.first), &source, {}, progress);
  GuessedLabels guesses{ref.id, Translated("follow person {}", ref.id), {}};
  for (size_t f = range.first; f < range.end; ++f)
    if (!IsKeyFrame(labels, {f, ref.id})) guesses.frames[f] = {.id = ref.id, .is_propagated = true};
  for (const FrameLabels& frame : followed.frames) {
    const auto found = guesses.frames.find(range.first + static_cast<size_t>(*frame.frame));
    if (found != guesses.frames.end() && !frame.people.empty()) found->second = frame.people[0];
  }
  return guesses;
}

GuessedLabels FollowFromFrameBefore(const Labels& labels, const std::filesystem::path& dir,
                                    PersonRef ref, const PhotoLifter& lifter) {
  const PersonRef before{ref.frame - 1, ref.id};
  if (ref.frame == 0 || !FindPerson(labels, before) ||
      FindPerson(labels, before)->landmarks.empty())
    throw InputError("found no labels of the person in the picture before, wanted some to follow");
  PersonLabels person = *FindPerson(labels, before);
  const LiftedPose pose = PoseOf(labels, before, lifter);
  for (LandmarkLabel& landmark :
       SeenBy(pose.camera, pose.joints_in_cam_m, *FindLayout(labels.layout), ref.id).landmarks)
    if (pose.camera.scale_px_per_m > 0.0 && !FindLandmark(labels, before, landmark.name))
      person.landmarks.push_back(std::move(landmark));
  Labels key = OfPerson(labels, ref.id, {before.frame}, before.frame);
  key.frames[0].people = {person};
  if (GoTogether(labels.frames[before.frame], labels.frames[ref.frame])) {
    RangeSource source(labels, dir, {before.frame, ref.frame + 1});
    const Labels followed = PropagateLabels(key, &source);
    for (LandmarkLabel& landmark : person.landmarks) {
      const LandmarkLabel* const moved = FindLandmark(followed, {1, ref.id}, landmark.name);
      if (moved && moved->state != LabelState::kAbsent)
        landmark = *moved;
      else if (landmark.state == LabelState::kVisible)
        landmark.state = LabelState::kOccluded;
    }
  }
  person.is_propagated = true;
  return {ref.id,
          Translated("follow person {} from the picture before", ref.id),
          {{ref.frame, std::move(person)}},
          true};
}

GuessedLabels PosesBetween(const Labels& labels, PersonRef ref, const PhotoLifter& lifter) {
  const auto before = IsKeyFrame(labels, ref) ? ref.frame : NextKeyFrame(labels, ref, -1);
  const auto behind = NextKeyFrame(labels, ref, 1);
  if (!before || !behind)
    throw InputError(
        "found no key pictures before and behind this one, wanted two to go from one to the other");
  const Skeleton& skeleton = lifter.dictionary().skeleton;
  const LiftedPose a = PoseOf(labels, {*before, ref.id}, lifter);
  const LiftedPose b = PoseOf(labels, {*behind, ref.id}, lifter);
  const double start_s = Time_s(labels, *before), length_s = Time_s(labels, *behind) - start_s;
  GuessedLabels guesses{ref.id, Translated("poses between of person {}", ref.id), {}};
  for (size_t f = *before + 1; f < *behind; ++f) {
    const double part = (Time_s(labels, f) - start_s) / length_s;
    const WeakCamera camera{
        .scale_px_per_m =
            std::pow(a.camera.scale_px_per_m, 1.0 - part) * std::pow(b.camera.scale_px_per_m, part),
        .translation_px = (1.0 - part) * a.camera.translation_px + part * b.camera.translation_px};
    PersonLabels& person = guesses.frames[f];
    const double size = (1.0 - part) * a.size + part * b.size;
    person =
        SeenBy(camera, size * JointPositions(skeleton, PoseBetween(skeleton, a.pose, b.pose, part)),
               *FindLayout(labels.layout), ref.id);
    person.is_propagated = true;
    // As of the line between two labels in label_propagation.h.
    const double off =
        PropagationOptions().acceleration * part * (1.0 - part) * length_s * length_s / 2.0;
    for (LandmarkLabel& landmark : person.landmarks)
      landmark.radius_px =
          std::max(1.0, Extent_px(person) * std::min(off, PropagationOptions().max_sigma));
  }
  return guesses;
}

LabelEdit PutGuesses(const Labels& labels, const GuessedLabels& guesses) {
  LabelEdit edit;
  edit.name = guesses.name;
  for (const auto& [frame, guess] : guesses.frames) {
    const PersonRef ref{frame, guesses.id};
    const PersonLabels* const old = FindPerson(labels, ref);
    if ((!guesses.replaces && IsKeyFrame(labels, ref)) || (!old && guess.landmarks.empty()))
      continue;
    std::vector<PersonLabels>& people = edit.people[frame];
    people = labels.frames.at(frame).people;
    std::erase_if(people, [&](const PersonLabels& person) { return person.id == guesses.id; });
    if (!guess.landmarks.empty()) people.push_back(guess);
  }
  return edit;
}

LabelEdit AcceptGuess(const Labels& labels, PersonRef ref) {
  LabelEdit edit;
  edit.name = Translated("accept person {}", ref.id);
  std::vector<PersonLabels>& people = edit.people[ref.frame];
  people = labels.frames.at(ref.frame).people;
  for (PersonLabels& person : people)
    if (person.id == ref.id) person.is_propagated = false;
  return edit;
}

}  // namespace poselift
