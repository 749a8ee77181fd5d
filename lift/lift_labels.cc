// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/lift_labels.h"

#include <atomic>

#include "src/forward_kinematics.h"
#include "src/joint_angles.h"

namespace poselift {
namespace {

// World of a level camera: y up, facing the camera.
SkeletonPose InWorld(const SkeletonPose& pose_in_cam) {
  SkeletonPose pose = pose_in_cam;
  const Eigen::Quaterniond world_from_cam(0.0, 1.0, 0.0, 0.0);  // half a turn about x
  pose.world_from_root = world_from_cam * pose_in_cam.world_from_root;
  pose.root_in_world_m = world_from_cam * pose_in_cam.root_in_world_m;
  return pose;
}

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
                           const Layout& layout) {
  if (!camera) return Observe(person, layout);
  const Pinhole pinhole{camera->fx_px, {camera->cx_px, camera->cy_px}};
  Observation observation = Observe(WithoutDistortion(person, *camera, pinhole), layout);
  observation.pinhole = pinhole;
  return observation;
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

std::vector<std::pair<std::string, double>> NamedAngles(const Skeleton& skeleton,
                                                        const SkeletonPose& pose_in_cam) {
  const Eigen::VectorXd values_deg = JointAngleReader(skeleton).ReadDeg(InWorld(pose_in_cam));
  std::vector<std::pair<std::string, double>> named;
  for (Eigen::Index i = 0; i < values_deg.size(); ++i)
    named.emplace_back(JointAngles()[i].name, values_deg[i]);
  return named;
}

PersonPose ToPersonPose(const LiftResult& result, const Observation& observation, int id,
                        const Skeleton& skeleton) {
  PersonPose person;
  person.id = id;
  person.status = StatusName(result.status);
  person.message = result.message;
  if (!result.IsUsable()) return person;
  const LiftedPose& best = result.poses.front();
  person.joints_in_cam_m = best.joints_in_cam_m;
  person.scale_px_per_m = best.camera.scale_px_per_m;
  person.translation_px = best.camera.translation_px;
  person.pelvis_in_cam_m = best.pelvis_in_cam_m;
  person.rotation_cam_from_body = Eigen::Quaterniond(best.camera.cam_from_body);
  person.angles_deg = NamedAngles(skeleton, best.pose);
  person.reprojection_rms_px = best.reprojection_rms_px;
  for (size_t i = 0; i < observation.points.size(); ++i)
    person.per_joint_px.emplace_back(observation.points[i].name,
                                     best.point_errors[static_cast<Eigen::Index>(i)]);
  for (size_t i = 0; i < best.code.atoms.size(); ++i)
    person.atoms.emplace_back(best.code.atoms[i],
                              best.code.coefficients[static_cast<Eigen::Index>(i)]);
  for (size_t i = 1; i < result.poses.size(); ++i)
    person.alternatives.push_back({result.poses[i].joints_in_cam_m, result.poses[i].cost,
                                   result.poses[i].reprojection_rms_px});
  return person;
}

}  // namespace

LiftedLabels LiftLabels(const PhotoLifter& lifter, const Labels& labels,
                        const std::optional<Camera>& camera, const ProgressFn& progress) {
  const Layout& layout = *FindLayout(labels.layout);
  LiftedLabels lifted;
  lifted.poses.frames.resize(labels.frames.size());
  lifted.results.resize(labels.frames.size());
  std::atomic<size_t> done = 0;
#pragma omp parallel for schedule(dynamic)
  for (size_t f = 0; f < labels.frames.size(); ++f) {
    const FrameLabels& frame = labels.frames[f];
    FramePoses& poses = lifted.poses.frames[f];
    poses.image = frame.image;
    poses.time_s = frame.time_s;
    for (const PersonLabels& person : frame.people) {
      const Observation observation = ObserveThrough(camera, person, layout);
      LiftResult result = lifter.LiftPhoto(observation);
      poses.people.push_back(
          ToPersonPose(result, observation, person.id, lifter.dictionary().skeleton));
      lifted.results[f].push_back(std::move(result));
    }
    const size_t now = ++done;
    if (progress) progress(static_cast<double>(now) / static_cast<double>(labels.frames.size()));
  }
  return lifted;
}

Motion ToMotion(const LiftedLabels& lifted, const Skeleton& skeleton, double frame_time_s) {
  Motion motion{skeleton, frame_time_s, {}};
  for (const auto& people : lifted.results) {
    if (people.empty() || !people.front().IsUsable()) {
      if (!motion.frames.empty()) motion.frames.push_back(motion.frames.back());
      continue;
    }
    SkeletonPose pose = InWorld(people.front().poses.front().pose);
    pose.root_in_world_m.y() -= JointPositions(skeleton, pose).row(1).minCoeff();
    motion.frames.push_back(std::move(pose));
  }
  return motion;
}

}  // namespace poselift
