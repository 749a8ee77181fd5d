// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/key_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/joint_angles.h"
#include "src/level_camera.h"
#include "src/monotone_curve.h"

namespace poselift {
namespace {

// A person at a key frame.
struct Key {
  int number = 0;
  LiftResult result;
  PersonPose person;

  const LiftedPose& pose() const { return result.poses.front(); }
};

// What goes along curves: the angles, the rotations of root and body as quaternions, the size.
Eigen::VectorXd ToColumn(const LiftedPose& pose) {
  Eigen::VectorXd column(pose.pose.dofs.size() + 9);
  column << pose.pose.dofs, pose.pose.world_from_root.coeffs(),
      Eigen::Quaterniond(pose.camera.cam_from_body).coeffs(), pose.size;
  return column;
}

// The same turned so that all goes the short way round from the one before.
void GoTheShortWay(const Skeleton& skeleton, const Eigen::VectorXd& before, Eigen::VectorXd* now) {
  Eigen::Index d = 0;
  for (const Bone& bone : skeleton.bones)
    for (const Dof& dof : bone.dofs) {
      if (dof.IsRotation())
        (*now)[d] = before[d] + std::remainder((*now)[d] - before[d], 2.0 * std::numbers::pi);
      ++d;
    }
  for (const Eigen::Index q : {d, d + 4})
    if (now->segment<4>(q).dot(before.segment<4>(q)) < 0.0) now->segment<4>(q) *= -1.0;
}

MonotoneCurve CurveThrough(const std::vector<Key>& keys, const Skeleton& skeleton) {
  std::vector<double> numbers;
  Eigen::MatrixXd columns(ToColumn(keys.front().pose()).size(), std::ssize(keys));
  for (const Key& key : keys) {
    Eigen::VectorXd column = ToColumn(key.pose());
    const auto k = std::ssize(numbers);
    if (k > 0) GoTheShortWay(skeleton, columns.col(k - 1), &column);
    columns.col(k) = column;
    numbers.push_back(key.number);
  }
  return {std::move(numbers), std::move(columns)};
}

LiftedPose FromColumn(const Eigen::VectorXd& column, const Skeleton& skeleton) {
  const Eigen::Index d = column.size() - 9;
  LiftedPose lifted;
  lifted.pose.dofs = column.head(d);
  lifted.pose.world_from_root = Eigen::Quaterniond(Eigen::Vector4d(column.segment<4>(d)));
  lifted.pose.world_from_root.normalize();
  lifted.joints_in_cam_m = JointPositions(skeleton, lifted.pose);
  const Eigen::Quaterniond cam_from_body(Eigen::Vector4d(column.segment<4>(d + 4)));
  lifted.camera = {.cam_from_body = cam_from_body.normalized().toRotationMatrix(),
                   .scale_px_per_m = 0.0};
  lifted.size = column[d + 8];
  return lifted;
}

// Of each person those that could be lifted.
std::map<int, std::vector<Key>> KeysOf(LiftedLabels lifted, const KeyTimes& times) {
  std::map<int, std::vector<Key>> keys;
  for (size_t f = 0; f < lifted.results.size(); ++f)
    for (size_t p = 0; p < lifted.results[f].size(); ++p) {
      PersonPose& person = lifted.poses.frames[f].people[p];
      if (!lifted.results[f][p].IsUsable()) continue;
      std::vector<Key>& of_person = keys[person.id];
      of_person.push_back({times.numbers[f], std::move(lifted.results[f][p]), std::move(person)});
    }
  return keys;
}

// first: the number of the motion's first frame.
void AddPerson(const std::vector<Key>& keys, int first, const Skeleton& skeleton,
               LiftedLabels* motion) {
  const MonotoneCurve curve = CurveThrough(keys, skeleton);
  const JointAngleReader angles(skeleton);
  Eigen::VectorXd angles_deg;  // of the frame before
  auto key = keys.begin();
  for (int number = keys.front().number; number <= keys.back().number; ++number) {
    LiftResult result{.status = LiftStatus::kOk, .message = ""};
    PersonPose person;
    if (key->number == number) {
      result = key->result;
      person = key++->person;
    } else {
      result.poses = {FromColumn(curve.At(number), skeleton)};
      person = ToPersonPose(result, {}, {.id = keys.front().person.id}, skeleton);
    }
    const SkeletonPose now = LevelFromCam(result.poses.front().pose);
    angles_deg = angles_deg.size() ? angles.ReadDeg(now, angles_deg) : angles.ReadDeg(now);
    for (Eigen::Index a = 0; a < angles_deg.size(); ++a)
      person.angles_deg[static_cast<size_t>(a)].second = angles_deg[a];
    const auto frame = static_cast<size_t>(number - first);
    motion->results[frame].push_back(std::move(result));
    motion->poses.frames[frame].people.push_back(std::move(person));
  }
}

// Of the last key frame that has one: there it is said best.
double RateOf(const Labels& labels, double unsaid) {
  constexpr double kLeast = 1.0, kMost = 1000.0, kDigits = 1e3;
  for (auto frame = labels.frames.rbegin(); frame != labels.frames.rend(); ++frame) {
    if (!frame->frame || !frame->time_s || !(*frame->time_s > 0.0)) continue;
    const double fps = std::round(kDigits * *frame->frame / *frame->time_s) / kDigits;
    if (fps >= kLeast && fps <= kMost) return fps;
  }
  return unsaid;
}

bool IsPinned(const PersonLabels& person) {
  constexpr int kLeast = 4;  // as in Observe
  const auto is_seen = [](const LandmarkLabel& label) {
    return label.state != LabelState::kAbsent;
  };
  const auto is_pin = [](const LabelHint& hint) { return hint.kind == LabelHint::Kind::kPin; };
  return std::ranges::count_if(person.landmarks, is_seen) < kLeast &&
         std::ranges::count_if(person.hints, is_pin) >= kLeast;
}

}  // namespace

bool AreKeyFrames(const Labels& labels) {
  const auto has_picture = [](const FrameLabels& frame) { return !frame.image.empty(); };
  const auto is_posed = [](const FrameLabels& frame) {
    return std::ranges::any_of(frame.people, IsPinned);
  };
  return std::ranges::none_of(labels.frames, has_picture) &&
         std::ranges::any_of(labels.frames, is_posed);
}

int KeyTimes::Gap() const { return std::max(1, static_cast<int>(std::lround(kGap_s * fps))); }

size_t KeyTimes::KeyAt(int number) const {
  const auto behind = std::ranges::upper_bound(numbers, number) - numbers.begin();
  return static_cast<size_t>(std::max<std::ptrdiff_t>(behind - 1, 0));
}

KeyTimes KeyTimesOf(const Labels& labels, double fps_unsaid) {
  KeyTimes times{.fps = RateOf(labels, fps_unsaid)};
  for (const FrameLabels& frame : labels.frames) {
    const bool is_first = times.numbers.empty();
    double number = is_first ? 0.0 : times.numbers.back() + times.Gap();
    if (frame.frame)
      number = *frame.frame;
    else if (frame.time_s)
      number = std::round(*frame.time_s * times.fps);
    const double least = is_first ? 0.0 : times.numbers.back() + 1.0;
    constexpr double kMost = 1e9;  // what an int holds, with room
    times.numbers.push_back(static_cast<int>(std::clamp(number, least, std::max(least, kMost))));
  }
  return times;
}

LiftedLabels LiftKeyFrames(const PhotoLifter& lifter, const Labels& labels,
                           const ProgressFn& progress) {
  const KeyTimes times = KeyTimesOf(labels);
  const int first = times.numbers.front(), num_frames = times.numbers.back() - first + 1;
  if (num_frames > KeyTimes::kMostNumber)
    throw InputError(fmt::format("found key frames {} frames apart, wanted a motion of up to {}",
                                 num_frames, KeyTimes::kMostNumber));
  LiftedLabels motion{.key_frame_time_s = times.Time_s(1)};
  LiftedLabels lifted = LiftLabels(lifter, labels, std::nullopt, progress);
  motion.poses.bodies = std::move(lifted.poses.bodies);
  const auto keys = KeysOf(std::move(lifted), times);
  motion.results.resize(static_cast<size_t>(num_frames));
  for (int number = first; number < first + num_frames; ++number)
    motion.poses.frames.push_back({.image = "", .time_s = times.Time_s(number), .people = {}});
  for (const auto& [id, of_person] : keys)
    AddPerson(of_person, first, lifter.dictionary().skeleton, &motion);
  return motion;
}

}  // namespace poselift
