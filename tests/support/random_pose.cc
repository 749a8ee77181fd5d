// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/random_pose.h"

#include <cmath>

namespace poselift::testing {

Eigen::Quaterniond RandomRotation(std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond rotation;
  for (double& c : rotation.coeffs()) c = normal(*rng);
  return rotation.normalized();
}

SkeletonPose RandomPoseWithinLimits(const Skeleton& skeleton, double part, std::mt19937_64* rng) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  SkeletonPose pose = SkeletonPose::Rest(skeleton);
  pose.world_from_root = RandomRotation(rng);
  for (double& x : pose.root_in_world_m) x = 2.0 * uniform(*rng);
  Eigen::Index d = 0;
  for (const Bone& bone : skeleton.bones)
    for (const Dof& dof : bone.dofs) {
      const double unlimited = dof.IsRotation() ? 1.0 : 0.1;
      const double lower = std::isfinite(dof.lower) ? dof.lower : -unlimited;
      const double upper = std::isfinite(dof.upper) ? dof.upper : unlimited;
      const double unit = 0.5 * (uniform(*rng) + 1.0);
      pose.dofs[d++] = part * (lower + unit * (upper - lower));
    }
  return pose;
}

}  // namespace poselift::testing
