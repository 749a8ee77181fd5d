// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/lift_labels.h"

#include <algorithm>
#include <map>

#include "lift/body_proportions.h"
#include "lift/frame_span.h"
#include "lift/normalize.h"
#include "lift/poses_to_motion.h"
#include "lift/temporal/frame_grid.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/joint_angles.h"
#include "src/level_camera.h"
#include "src/loop_progress.h"

namespace poselift {
namespace {

// As a pinhole camera with square pixels would have taken the picture.
PersonLabels WithoutDistortion(PersonLabels labels, const Camera& camera, const Pinhole& pinhole) {
  for (LandmarkLabel& label : labels.landmarks) {
    if (label.state == LabelState::kAbsent) continue;
    const Eigen::Vector3d ray = camera.Undistort(label.x_px);
    label.x_px = pinhole.centre_px + pinhole.focal_px * ray.head<2>();
    if (!label.x_px.allFinite()) label = {label.name, Eigen::Vector2d::Zero(), LabelState::kAbsent};
  }
  return labels;
}

Observation ObserveThrough(const std::optional<Camera>& camera, const PersonLabels& person,
                           const Layout& layout, const ObserveOptions& options = {}) {
  if (!camera) return Observe(person, layout, options);
  const Pinhole pinhole{camera->fx_px, {camera->cx_px, camera->cy_px}};
  Observation observation = Observe(WithoutDistortion(person, *camera, pinhole), layout, options);
  observation.pinhole = pinhole;
  return observation;
}

std::optional<size_t> FindPerson(const std::vector<PersonLabels>& people, int id) {
  for (size_t p = 0; p < people.size(); ++p)
    if (people[p].id == id) return p;
  return std::nullopt;
}

// The frames' times as places of an even grid; without an even one the nearest
// places at the median step.
FrameGrid GridOf(const Labels& labels) {
  std::vector<double> times_s;
  for (const FrameLabels& frame : labels.frames) {
    if (!frame.time_s)
      throw InputError("found a frame without time_s, wanted times for a sequence");
    times_s.push_back(*frame.time_s);
  }
  FrameGrid grid = FitFrameGrid(times_s);
  if (grid.is_even) return grid;
  grid.first_s = times_s.front();
  for (const double time_s : times_s) {
    const int nearest = static_cast<int>(std::lround((time_s - grid.first_s) / grid.frame_time_s));
    grid.places.push_back(grid.places.empty() ? 0 : std::max(nearest, grid.places.back() + 1));
  }
  return grid;
}

// One person, from their first frame to their last.
struct Track {
  struct Labelled {
    size_t frame, person;  // of the labels
    size_t place;          // in observations
  };
  std::vector<Observation> observations;
  std::vector<Labelled> labelled;
};

Track TrackOf(const Labels& labels, int id, const FrameGrid& grid,
              const std::optional<Camera>& camera, const Layout& layout) {
  Track track;
  int first_place = 0;
  for (size_t f = 0; f < labels.frames.size(); ++f) {
    const auto person = FindPerson(labels.frames[f].people, id);
    if (!person) continue;
    if (track.labelled.empty()) first_place = grid.places[f];
    const auto place = static_cast<size_t>(grid.places[f] - first_place);
    track.observations.resize(place + 1);
    track.observations[place] = ObserveThrough(camera, labels.frames[f].people[*person], layout,
                                               {.pins_may_be_points = false});
    track.labelled.push_back({f, *person, place});
  }
  return track;
}

const char* StatusName(LiftStatus status) {
  switch (status) {
    case LiftStatus::kNotRun:
      return "not run";
    case LiftStatus::kOk:
      return "ok";
    case LiftStatus::kCannotLift:
      return "cannot lift";
    case LiftStatus::kFailed:
      return "failed";
  }
  return "";
}

std::vector<std::pair<std::string, double>> Named(const Eigen::VectorXd& angles_deg) {
  std::vector<std::pair<std::string, double>> named;
  for (Eigen::Index i = 0; i < angles_deg.size(); ++i)
    named.emplace_back(JointAngles()[i].name, angles_deg[i]);
  return named;
}

std::string UnmetHintsMessage(const LiftedPose& lifted, const std::vector<LabelHint>& hints) {
  std::string message;
  for (const int hint : lifted.unmet_hints)
    message +=
        (message.empty() ? "hints not met: " : "; ") + Describe(hints[static_cast<size_t>(hint)]);
  return message;
}

// Bones at the size of a person whose proportions were not looked for.
PersonBones BonesAtSize(int id, double size, const Skeleton& skeleton) {
  const Eigen::VectorXd lengths_m = BoneLengths(skeleton);
  PersonBones bones = BonesOf(AtEqualStature(ProportionPrior(), lengths_m), size * lengths_m);
  bones.id = id;
  return bones;
}

// Of everyone in frames lifted one by one of whom a hint said how tall they are.
std::vector<PersonBones> BonesOfKnownSize(const LiftedLabels& lifted, const Skeleton& skeleton) {
  std::vector<PersonBones> bodies;
  for (size_t f = 0; f < lifted.results.size(); ++f)
    for (size_t p = 0; p < lifted.results[f].size(); ++p) {
      const LiftResult& result = lifted.results[f][p];
      const int id = lifted.poses.frames[f].people[p].id;
      const bool is_new = std::none_of(bodies.begin(), bodies.end(),
                                       [&](const PersonBones& body) { return body.id == id; });
      if (is_new && result.IsUsable() && result.poses.front().size != 1.0)
        bodies.push_back(BonesAtSize(id, result.poses.front().size, skeleton));
    }
  return bodies;
}

double SizeOf(const LiftedSequence& sequence) {
  for (const LiftResult& frame : sequence.frames)
    if (frame.IsUsable()) return frame.poses.front().size;
  return 1.0;
}

}  // namespace

PersonPose ToPersonPose(const LiftResult& result, const Observation& observation,
                        const PersonLabels& labels, const Skeleton& skeleton) {
  PersonPose person;
  person.id = labels.id;
  person.status = StatusName(result.status);
  person.message = result.message;
  if (!result.IsUsable()) return person;
  const LiftedPose& best = result.poses.front();
  if (!best.unmet_hints.empty()) person.message = UnmetHintsMessage(best, labels.hints);
  person.joints_in_cam_m = best.size * best.joints_in_cam_m;
  person.scale_px_per_m = best.camera.scale_px_per_m / best.size;
  person.translation_px = best.camera.translation_px;
  person.pelvis_in_cam_m = best.size * best.pelvis_in_cam_m;
  person.rotation_cam_from_body = Eigen::Quaterniond(best.camera.cam_from_body);
  person.angles_deg = Named(JointAngleReader(skeleton).ReadDeg(LevelFromCam(best.pose)));
  person.angles_sigma_deg = Named(best.angles_sigma_deg);
  person.reprojection_rms_px = best.reprojection_rms_px;
  if (observation.Count(ObservedPoint::Kind::k2D) == 0) {  // no camera is known
    person.scale_px_per_m = person.reprojection_rms_px = std::nan("");
    person.translation_px.setConstant(std::nan(""));
  }
  for (size_t i = 0; i < observation.points.size(); ++i)
    if (observation.points[i].kind == ObservedPoint::Kind::k2D)
      person.per_joint_px.emplace_back(observation.points[i].name,
                                       best.point_errors[static_cast<Eigen::Index>(i)]);
  for (size_t i = 0; i < best.code.atoms.size(); ++i)
    person.atoms.emplace_back(best.code.atoms[i],
                              best.code.coefficients[static_cast<Eigen::Index>(i)]);
  for (size_t i = 1; i < result.poses.size(); ++i)
    person.alternatives.push_back({best.size * result.poses[i].joints_in_cam_m,
                                   result.poses[i].cost, result.poses[i].reprojection_rms_px});
  return person;
}

LiftedLabels LiftLabels(const PhotoLifter& lifter, const Labels& labels,
                        const std::optional<Camera>& camera, const ProgressFn& progress) {
  const Layout& layout = *FindLayout(labels.layout);
  LiftedLabels lifted;
  lifted.poses.frames.resize(labels.frames.size());
  lifted.results.resize(labels.frames.size());
  LoopProgress so_far(progress, labels.frames.size());
#pragma omp parallel for schedule(dynamic)
  for (size_t f = 0; f < labels.frames.size(); ++f) {
    if (so_far.IsStopped()) continue;
    const FrameLabels& frame = labels.frames[f];
    FramePoses& poses = lifted.poses.frames[f];
    poses.image = frame.image;
    poses.time_s = frame.time_s;
    for (const PersonLabels& person : frame.people) {
      const Observation observation = ObserveThrough(camera, person, layout);
      LiftResult result = lifter.LiftPhoto(observation);
      poses.people.push_back(
          ToPersonPose(result, observation, person, lifter.dictionary().skeleton));
      lifted.results[f].push_back(std::move(result));
    }
    so_far.Advance();
  }
  so_far.Finish();
  lifted.poses.bodies = BonesOfKnownSize(lifted, lifter.dictionary().skeleton);
  return lifted;
}

Labels WithPeopleBetween(const Labels& labels) {
  std::map<int, FrameSpan> spans;  // of each person
  for (int f = 0; f < std::ssize(labels.frames); ++f)
    for (const PersonLabels& person : labels.frames[static_cast<size_t>(f)].people)
      spans.try_emplace(person.id, FrameSpan{f, f}).first->second.last = f;
  Labels complete = labels;
  for (const auto& [id, span] : spans)
    for (int f = span.first; f <= span.last; ++f) {
      auto& people = complete.frames[static_cast<size_t>(f)].people;
      if (!FindPerson(people, id)) people.push_back({id, {}});
    }
  return complete;
}

LiftedLabels LiftLabelsOverTime(const SequenceLifter& lifter, const Skeleton& skeleton,
                                const Labels& labels, const std::optional<Camera>& camera,
                                const ProgressFn& progress) {
  const Layout& layout = *FindLayout(labels.layout);
  const FrameGrid grid = GridOf(labels);
  LiftedLabels lifted;
  std::vector<int> ids;
  for (const FrameLabels& frame : labels.frames) {
    lifted.poses.frames.push_back({frame.image, frame.time_s, {}});
    lifted.results.emplace_back(frame.people.size());
    lifted.poses.frames.back().people.resize(frame.people.size());
    for (const PersonLabels& person : frame.people)
      if (std::find(ids.begin(), ids.end(), person.id) == ids.end()) ids.push_back(person.id);
  }
  for (size_t i = 0; i < ids.size(); ++i) {
    const Track track = TrackOf(labels, ids[i], grid, camera, layout);
    const auto so_far = [&](double part) {
      if (progress) progress((static_cast<double>(i) + part) / static_cast<double>(ids.size()));
    };
    LiftedSequence sequence = lifter.LiftSequence(track.observations, grid.frame_time_s, so_far);
    const double size = SizeOf(sequence);
    if (!sequence.body.covariance.isZero()) {
      PersonBones bones = BonesOf(sequence.body, size * BoneLengths(skeleton));
      bones.id = ids[i];
      lifted.poses.bodies.push_back(std::move(bones));
    } else if (size != 1.0) {
      lifted.poses.bodies.push_back(BonesAtSize(ids[i], size, skeleton));
    }
    const JointAngleReader angles(sequence.skeleton);
    Eigen::VectorXd angles_deg;  // of the frame before
    for (const auto& [frame, person, place] : track.labelled) {
      PersonPose& pose = lifted.poses.frames[frame].people[person];
      pose = ToPersonPose(sequence.frames[place], track.observations[place],
                          labels.frames[frame].people[person], sequence.skeleton);
      if (sequence.filled[place]) pose.status = kFilledStatus;
      if (sequence.frames[place].IsUsable()) {
        const SkeletonPose now = LevelFromCam(sequence.frames[place].poses.front().pose);
        angles_deg = angles_deg.size() ? angles.ReadDeg(now, angles_deg) : angles.ReadDeg(now);
        pose.angles_deg = Named(angles_deg);
      }
      lifted.results[frame][person] = std::move(sequence.frames[place]);
    }
  }
  return lifted;
}

Motion ToMotion(const LiftedLabels& lifted, const Skeleton& skeleton, double frame_time_s) {
  const std::vector<PersonBones>& bodies = lifted.poses.bodies;
  Motion motion{bodies.empty() ? skeleton : WithBoneLengths(skeleton, bodies.front().lengths_m),
                frame_time_s,
                {}};
  for (const auto& people : lifted.results) {
    if (people.empty() || !people.front().IsUsable()) {
      if (!motion.frames.empty()) motion.frames.push_back(motion.frames.back());
      continue;
    }
    SkeletonPose pose = LevelFromCam(people.front().poses.front().pose);
    pose.root_in_world_m.y() -= JointPositions(motion.skeleton, pose).row(1).minCoeff();
    motion.frames.push_back(std::move(pose));
  }
  return motion;
}

Motion ToMotionOverTime(const LiftedLabels& lifted, const Skeleton& skeleton,
                        const ProgressFn& progress) {
  if (lifted.key_frame_time_s) return ToMotion(lifted, skeleton, *lifted.key_frame_time_s);
  PosesMotion placed = PosesToMotion(lifted.poses, skeleton, {.with_filled = true}, progress);
  std::vector<SkeletonPose>& frames = placed.motion.frames;
  for (size_t t = 0; t < frames.size(); ++t) {
    if (!IsKnown(frames[t])) {
      if (t > 0) frames[t] = frames[t - 1];
      continue;
    }
    // The joints alone do not tell every angle: those of the lift are better.
    if (placed.source_frames[t] < 0) continue;
    const auto source = static_cast<size_t>(placed.source_frames[t]);
    const auto& people = lifted.poses.frames[source].people;
    for (size_t p = 0; p < people.size(); ++p)
      if (people[p].id == placed.person_id) {
        const SkeletonPose pose = LevelFromCam(lifted.results[source][p].poses.front().pose);
        frames[t].dofs = pose.dofs;
        frames[t].world_from_root = pose.world_from_root;
      }
  }
  const auto known = std::find_if(frames.begin(), frames.end(), IsKnown);
  frames.erase(frames.begin(), known);
  return std::move(placed.motion);
}

}  // namespace poselift
