// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "lift/ik/articulation.h"
#include "lift/tracking/tag_tracker.h"
#include "src/camera.h"
#include "src/joint_angles.h"
#include "src/poses.h"

namespace poselift {

// What a TagTracker finds as poses.json has it: before the camera, with joint angles that
// are continuous and how sure they are.
class TrackedPerson {
 public:
  // The tracker's. Throws InputError for a skeleton without the bones of the CMU skeleton.
  TrackedPerson(const Skeleton& skeleton, const Camera& camera,
                const Eigen::Quaterniond& cam_from_world);

  // In the frames' order. Statuses are "ok", kFilledStatus and kUnknownStatus.
  PersonPose Convert(const TrackedFrame& frame);

 private:
  Eigen::VectorXd JointsSigma_m(const SkeletonPose& pose, const Eigen::MatrixXd& covariance) const;

  Articulation body_;
  Camera camera_;
  Eigen::Quaterniond cam_from_world_;
  JointAngleReader reader_;
  Eigen::VectorXd last_deg_;
};

}  // namespace poselift
