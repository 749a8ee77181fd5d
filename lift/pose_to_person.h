// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

#include "lift/camera_track.h"
#include "lift/ik/articulation.h"
#include "src/joint_angles.h"
#include "src/poses.h"

namespace poselift {

// The way back from PersonIk: poses of a skeleton, one after the other, as lifted
// poses before a camera. Angles are continuous.
class PoseToPerson {
 public:
  // Throws InputError for a skeleton without the bones of the CMU skeleton.
  explicit PoseToPerson(const Skeleton& skeleton) : body_(skeleton), reader_(skeleton) {}

  // The pose is known. scale_px_per_m: of the frame, where depth is not known.
  PersonPose Convert(const SkeletonPose& pose, const CameraTrack& camera, double scale_px_per_m);

 private:
  Articulation body_;
  JointAngleReader reader_;
  Eigen::VectorXd last_deg_;
};

}  // namespace poselift
