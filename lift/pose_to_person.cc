// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/pose_to_person.h"

#include "src/level_camera.h"

namespace poselift {

PersonPose PoseToPerson::Convert(const SkeletonPose& pose, const CameraTrack& camera,
                                 double scale_px_per_m) {
  PersonPose person;
  const Pose3 joints_m = JointPositions(body_, pose).colwise() - pose.root_in_world_m;
  person.joints_in_cam_m = kLevelFromCam.toRotationMatrix() * joints_m;
  person.rotation_cam_from_body = kLevelFromCam * pose.world_from_root;

  const Eigen::Vector3d pelvis_in_cam_m =
      kLevelFromCam * (pose.root_in_world_m + camera.world_in_level_cam_m);
  person.scale_px_per_m = scale_px_per_m;
  if (camera.has_depth) {
    person.pelvis_in_cam_m = pelvis_in_cam_m;
    person.scale_px_per_m = camera.focal_px / pelvis_in_cam_m.z();
  }
  person.translation_px = camera.centre_px + person.scale_px_per_m * pelvis_in_cam_m.head<2>();

  last_deg_ = last_deg_.size() == 0 ? reader_.ReadDeg(pose) : reader_.ReadDeg(pose, last_deg_);
  for (Eigen::Index a = 0; a < last_deg_.size(); ++a)
    person.angles_deg.emplace_back(JointAngles()[static_cast<size_t>(a)].name, last_deg_[a]);
  return person;
}

}  // namespace poselift
