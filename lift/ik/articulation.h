// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "src/forward_kinematics.h"
#include "src/skeleton.h"

namespace poselift {

// A skeleton with what is looked up once: finding it by name takes longer than
// a solve.
struct Articulation {
  explicit Articulation(Skeleton skeleton_in)
      : skeleton(std::move(skeleton_in)),
        sites(FindJointSites(skeleton)),
        dof_starts(skeleton.DofStarts()),
        num_dofs(skeleton.NumDofs()) {}

  Skeleton skeleton;
  JointSites sites;             // where the 23 joints sit
  std::vector<int> dof_starts;  // of each bone
  int num_dofs;
};

// The range of each dof, radians or metres.
struct DofLimits {
  Eigen::VectorXd lower;  // D
  Eigen::VectorXd upper;  // D

  // Those of the skeleton, or none at all.
  DofLimits(const Articulation& body, bool enforce) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    lower.setConstant(body.num_dofs, -kInfinity);
    upper.setConstant(body.num_dofs, kInfinity);
    if (!enforce) return;
    Eigen::Index d = 0;
    for (const Bone& bone : body.skeleton.bones)
      for (const Dof& dof : bone.dofs) {
        lower[d] = dof.lower;
        upper[d++] = dof.upper;
      }
  }

  Eigen::VectorXd Clamp(const Eigen::VectorXd& dofs) const {
    return dofs.cwiseMax(lower).cwiseMin(upper);
  }
};

// f(q) without the look-up.
inline Pose3 JointPositions(const Articulation& body, const SkeletonPose& pose) {
  BoneFrames frames;
  ForwardKinematics(body.skeleton, pose, &frames);
  return JointPositions(body.sites, frames);
}

}  // namespace poselift
