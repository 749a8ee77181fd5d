// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/poses_to_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lift/body_proportions.h"
#include "lift/person_ik.h"
#include "lift/pose_to_person.h"
#include "lift/temporal/frame_grid.h"
#include "lift/temporal/resample.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kFloorQuantile = 0.05;

int FindPerson(const Poses& poses, const std::optional<int>& wanted) {
  std::vector<int> ids;
  for (const FramePoses& frame : poses.frames)
    for (const PersonPose& person : frame.people) {
      if (person.id == wanted || !wanted) return person.id;
      if (std::find(ids.begin(), ids.end(), person.id) == ids.end()) ids.push_back(person.id);
    }
  if (ids.empty()) throw InputError("found poses without any person, wanted at least one");
  throw InputError(
      fmt::format("found no person {}, wanted one of {}", *wanted, fmt::join(ids, ", ")));
}

std::optional<PersonBones> BonesOf(const Poses& poses, int person_id) {
  for (const PersonBones& body : poses.bodies)
    if (body.id == person_id) return body;
  return std::nullopt;
}

// The person in each frame if there is a pose of theirs, else null.
std::vector<const PersonPose*> FramesOf(const Poses& poses, int person_id, bool with_filled) {
  std::vector<const PersonPose*> frames;
  for (const FramePoses& frame : poses.frames) {
    frames.push_back(nullptr);
    for (const PersonPose& person : frame.people)
      if (person.id == person_id &&
          (person.status == "ok" || (with_filled && person.status == kFilledStatus)))
        frames.back() = &person;
  }
  if (std::all_of(frames.begin(), frames.end(), [](auto* person) { return !person; }))
    throw InputError(
        fmt::format("found no frame in which person {} has the status \"ok\"", person_id));
  return frames;
}

std::vector<double> TimesOf(const Poses& poses, const std::optional<double>& frame_time_s) {
  std::vector<double> times_s;
  for (size_t f = 0; f < poses.frames.size(); ++f) {
    if (!frame_time_s && !poses.frames[f].time_s)
      throw InputError(fmt::format(
          "frames[{}]: found no time_s, wanted the time of each frame, or their rate (--fps)", f));
    times_s.push_back(frame_time_s ? static_cast<double>(f) * *frame_time_s
                                   : *poses.frames[f].time_s);
  }
  return times_s;
}

// On level axes, the camera at the origin; unknown where there is no pose.
std::vector<SkeletonPose> SolveFrames(const std::vector<const PersonPose*>& people,
                                      const Skeleton& skeleton, const ProgressFn& progress,
                                      PosesMotion* result) {
  PersonIk ik(skeleton);
  std::vector<SkeletonPose> poses(people.size(), UnknownPose(skeleton));
  for (size_t f = 0; f < people.size(); ++f) {
    if (progress) progress(static_cast<double>(f) / static_cast<double>(people.size()));
    if (people[f]) poses[f] = ik.Solve(*people[f], result->camera);
  }
  result->worst_ik_rms_m = ik.worst_rms_m();
  result->num_ik_failures = ik.num_failures();
  return poses;
}

// Straight lines through values that are known at some times.
class Polyline {
 public:
  void Add(double time_s, double value) {
    if (!std::isfinite(value)) return;
    times_s_.push_back(time_s);
    values_.push_back(value);
  }
  double At(double time_s) const {
    if (values_.empty()) return kUnknown;
    const auto after = std::lower_bound(times_s_.begin(), times_s_.end(), time_s);
    if (after == times_s_.begin()) return values_.front();
    if (after == times_s_.end()) return values_.back();
    const auto i = after - times_s_.begin();
    const double part = (time_s - times_s_[i - 1]) / (times_s_[i] - times_s_[i - 1]);
    return values_[i - 1] + part * (values_[i] - values_[i - 1]);
  }

 private:
  std::vector<double> times_s_, values_;
};

void PlaceOnGrid(const std::vector<SkeletonPose>& poses, const std::vector<double>& times_s,
                 const FrameGrid& grid, const Skeleton& skeleton, PosesMotion* result) {
  result->is_resampled = !grid.is_even;
  if (grid.is_even) {
    result->motion = {skeleton, grid.frame_time_s, {}};
    result->motion.frames.assign(grid.places.back() + 1, UnknownPose(skeleton));
    result->source_frames.assign(grid.places.back() + 1, -1);
    for (size_t i = 0; i < poses.size(); ++i) {
      result->motion.frames[grid.places[i]] = poses[i];
      result->source_frames[grid.places[i]] = static_cast<int>(i);
    }
  } else {
    result->motion = ResampleUneven(skeleton, poses, times_s, grid.frame_time_s);
    result->source_frames.assign(result->motion.frames.size(), -1);
  }
}

// Those of JointAngles() among the values; NaN where one is missing.
Eigen::VectorXd InOrder(const std::vector<std::pair<std::string, double>>& values) {
  Eigen::VectorXd ordered = Eigen::VectorXd::Constant(std::ssize(JointAngles()), kUnknown);
  for (const auto& [name, value] : values)
    for (Eigen::Index a = 0; a < ordered.size(); ++a)
      if (JointAngles()[a].name == name) ordered[a] = value;
  return ordered;
}

void KeepSureAngles(const std::vector<const PersonPose*>& people, PosesMotion* result) {
  if (std::all_of(people.begin(), people.end(), [](const PersonPose* person) {
        return !person || person->angles_sigma_deg.empty();
      }))
    return;
  result->angles_deg = Eigen::MatrixXd::Constant(std::ssize(JointAngles()),
                                                 std::ssize(result->source_frames), kUnknown);
  result->angles_sigma_deg = result->angles_deg;
  for (Eigen::Index k = 0; k < result->angles_deg.cols(); ++k) {
    const int source = result->source_frames[static_cast<size_t>(k)];
    if (source < 0 || !people[source]) continue;
    result->angles_deg.col(k) = InOrder(people[source]->angles_deg);
    result->angles_sigma_deg.col(k) = InOrder(people[source]->angles_sigma_deg);
  }
}

double LowestHeight_m(const Skeleton& skeleton, const SkeletonPose& pose) {
  const Pose3 joints_m = JointPositions(skeleton, pose);
  double lowest_m = HUGE_VAL;
  for (Eigen::Index j = 0; j < joints_m.cols(); ++j)
    if (joints_m.col(j).allFinite()) lowest_m = std::min(lowest_m, joints_m(1, j));
  return lowest_m;
}

// World's origin on the floor, below the first known pelvis.
void StandOnFloor(PosesMotion* result) {
  const bool is_placed = result->camera.has_depth || result->camera.centre_px.allFinite();
  std::vector<double> lowest_m;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  for (SkeletonPose& pose : result->motion.frames) {
    if (!IsKnown(pose)) continue;
    if (lowest_m.empty()) origin_m = pose.root_in_world_m;
    lowest_m.push_back(LowestHeight_m(result->motion.skeleton, pose));
    if (!is_placed) pose.root_in_world_m.y() -= std::exchange(lowest_m.back(), 0.0);
  }
  if (lowest_m.empty()) throw InputError("found no pose that a skeleton could take");
  const auto quantile =
      lowest_m.begin() +
      static_cast<ptrdiff_t>(kFloorQuantile * static_cast<double>(lowest_m.size()));
  std::nth_element(lowest_m.begin(), quantile, lowest_m.end());
  origin_m.y() = *quantile;
  for (SkeletonPose& pose : result->motion.frames) pose.root_in_world_m -= origin_m;
  result->camera.world_in_level_cam_m = origin_m;
}

}  // namespace

PosesMotion PosesToMotion(const Poses& poses, const Skeleton& skeleton,
                          const PosesToMotionOptions& options, const ProgressFn& progress) {
  PosesMotion result;
  result.person_id = FindPerson(poses, options.person_id);
  result.bones = BonesOf(poses, result.person_id);
  const Skeleton own = result.bones ? WithBoneLengths(skeleton, result.bones->lengths_m) : skeleton;
  const std::vector<const PersonPose*> people =
      FramesOf(poses, result.person_id, options.with_filled);
  const std::vector<double> times_s = TimesOf(poses, options.frame_time_s);
  const FrameGrid grid = FitFrameGrid(times_s);
  result.camera = FindCamera(people);
  PlaceOnGrid(SolveFrames(people, own, progress, &result), times_s, grid, own, &result);
  StandOnFloor(&result);
  if (!result.is_resampled) KeepSureAngles(people, &result);

  Polyline scales_px_per_m;
  for (size_t f = 0; f < people.size(); ++f)
    if (people[f]) scales_px_per_m.Add(times_s[f], people[f]->scale_px_per_m);
  for (size_t k = 0; k < result.motion.frames.size(); ++k) {
    const int source = result.source_frames[k];
    const double time_s =
        source >= 0 ? times_s[source] : grid.first_s + static_cast<double>(k) * grid.frame_time_s;
    result.camera.scale_px_per_m.push_back(scales_px_per_m.At(time_s));
    result.images.push_back(source >= 0 ? poses.frames[source].image : "");
    result.is_filled.push_back(source >= 0 && people[source] &&
                               people[source]->status == kFilledStatus);
    if (!options.frame_time_s) result.times_s.push_back(time_s);
  }
  return result;
}

Poses MotionToPoses(const Motion& motion, const PosesMotion& source,
                    const std::vector<std::string>& statuses) {
  if (statuses.size() != motion.frames.size())
    throw std::invalid_argument("MotionToPoses: a status for each frame is wanted");
  PoseToPerson to_person(motion.skeleton);
  Poses poses;
  if (source.bones) poses.bodies.push_back(*source.bones);
  for (size_t f = 0; f < motion.frames.size(); ++f) {
    FramePoses& frame = poses.frames.emplace_back();
    if (f < source.images.size()) frame.image = source.images[f];
    if (f < source.times_s.size()) frame.time_s = source.times_s[f];
    const auto& scales_px_per_m = source.camera.scale_px_per_m;
    PersonPose person =
        statuses[f] == kUnknownStatus
            ? PersonPose{}
            : to_person.Convert(motion.frames[f], source.camera,
                                f < scales_px_per_m.size() ? scales_px_per_m[f] : kUnknown);
    person.id = source.person_id;
    person.status = statuses[f];
    if (statuses[f] == kUnknownStatus) person.message = kUnknownMessage;
    frame.people.push_back(std::move(person));
  }
  return poses;
}

}  // namespace poselift
