// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "lift/camera_track.h"
#include "lift/ik/inverse_kinematics.h"
#include "src/motion.h"
#include "src/poses.h"

namespace poselift {

// A person of lifted poses, frame after frame, as poses of a skeleton: inverse
// kinematics, each frame from the one before.
class PersonIk {
 public:
  explicit PersonIk(const Skeleton& skeleton) : ik_(skeleton) {}

  // On the axes of a level camera (poses_to_motion.h) that stands at the origin;
  // the pelvis is where `camera` has it. Unknown when no pose of the skeleton fits.
  SkeletonPose Solve(const PersonPose& person, const CameraTrack& camera);

  double worst_rms_m() const { return worst_rms_m_; }
  int num_failures() const { return num_failures_; }

 private:
  InverseKinematics ik_;
  IkHints hints_;
  double worst_rms_m_ = 0.0;
  int num_failures_ = 0;
};

}  // namespace poselift
