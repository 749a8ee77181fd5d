// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/normalize.h"

#include "src/forward_kinematics.h"

namespace poselift {

Eigen::VectorXd BoneLengths(const Skeleton& skeleton) {
  const Pose3 rest = JointPositions(skeleton, SkeletonPose::Rest(skeleton));
  Eigen::VectorXd lengths = Eigen::VectorXd::Zero(kNumJoints);
  for (int j = 1; j < kNumJoints; ++j)
    lengths[j] = (rest.col(j) - rest.col(Joints()[j].parent)).norm();
  return lengths;
}

Pose3 NormalizePose(const Pose3& pose, const Eigen::VectorXd& bone_lengths_m) {
  Pose3 normalized = pose;
  for (const std::span<const int> chain : JointChains()) {
    Eigen::Vector3d direction = Eigen::Vector3d::UnitY();
    for (size_t i = 1; i < chain.size(); ++i) {
      const int k = chain[i];
      const int parent = chain[i - 1];
      const Eigen::Vector3d bone = pose.col(k) - pose.col(parent);
      if (const double length = bone.norm(); length > 0.0) direction = bone / length;
      // The parent's new position: the printed algorithm has only its shift.
      normalized.col(k) = normalized.col(parent) + direction * bone_lengths_m[k];
    }
  }
  return normalized;
}

}  // namespace poselift
