// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/person_ik.h"

#include <algorithm>

#include "src/level_camera.h"

namespace poselift {
namespace {

// Zero where nobody knows: a person in space without any picture.
Eigen::Vector3d PelvisInCam_m(const PersonPose& person, const CameraTrack& camera) {
  if (camera.has_depth) return person.pelvis_in_cam_m;
  const Eigen::Vector2d in_plane_m =
      (person.translation_px - camera.centre_px) / person.scale_px_per_m;
  if (!in_plane_m.allFinite()) return Eigen::Vector3d::Zero();
  return {in_plane_m.x(), in_plane_m.y(), 0.0};
}

}  // namespace

SkeletonPose PersonIk::Solve(const PersonPose& person, const CameraTrack& camera) {
  const Pose3 target_m = kLevelFromCam.toRotationMatrix() * person.joints_in_cam_m;
  const IkResult solved = ik_.Solve(target_m, hints_);
  if (!IsUsable(solved.status)) {
    ++num_failures_;
    return UnknownPose(ik_.body().skeleton);
  }
  worst_rms_m_ = std::max(worst_rms_m_, solved.rms_m);
  hints_.start = solved.pose;
  SkeletonPose pose = solved.pose;
  pose.root_in_world_m += kLevelFromCam * PelvisInCam_m(person, camera);
  return pose;
}

}  // namespace poselift
