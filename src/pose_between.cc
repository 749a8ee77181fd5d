// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/pose_between.h"

#include <cmath>
#include <numbers>

namespace poselift {

SkeletonPose PoseBetween(const Skeleton& skeleton, const SkeletonPose& a, const SkeletonPose& b,
                         double part) {
  SkeletonPose pose;
  pose.root_in_world_m = (1.0 - part) * a.root_in_world_m + part * b.root_in_world_m;
  pose.world_from_root = a.world_from_root.slerp(part, b.world_from_root);
  pose.dofs = b.dofs - a.dofs;
  Eigen::Index d = 0;
  for (const Bone& bone : skeleton.bones)
    for (const Dof& dof : bone.dofs) {
      if (dof.IsRotation()) pose.dofs[d] = std::remainder(pose.dofs[d], 2.0 * std::numbers::pi);
      ++d;
    }
  pose.dofs = a.dofs + part * pose.dofs;
  return pose;
}

}  // namespace poselift
