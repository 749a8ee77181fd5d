// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/pose_difference.h"

#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond Heading(const SkeletonPose& pose) {
  return Quaterniond(Eigen::AngleAxisd(Yaw(pose.world_from_root), Vector3d::UnitY()));
}

}  // namespace

FeatureVector PoseDifference(const SkeletonPose& pose, const SkeletonPose& mean) {
  const Quaterniond heading_from_world = Heading(mean).conjugate();
  Quaterniond turn = pose.world_from_root * mean.world_from_root.conjugate();
  if (turn.w() < 0.0) turn.coeffs() *= -1.0;
  const Vector3d v = 2.0 * (heading_from_world * turn.vec());
  const Vector3d p_m = heading_from_world * (pose.root_in_world_m - mean.root_in_world_m);
  FeatureVector difference;
  difference << pose.dofs - mean.dofs, p_m.y(), v.x(), v.z(), p_m.x(), p_m.z(), v.y();
  return difference;
}

SkeletonPose MovedBy(const SkeletonPose& mean, const FeatureVector& difference) {
  const Quaterniond world_from_heading = Heading(mean);
  const auto tail = difference.tail<6>();
  Vector3d half_v = 0.5 * Vector3d(tail[1], tail[5], tail[2]);
  if (const double length = half_v.norm(); length > 1.0) half_v /= length;
  const Vector3d vec = world_from_heading * half_v;
  const Quaterniond turn(std::sqrt(std::max(0.0, 1.0 - vec.squaredNorm())), vec.x(), vec.y(),
                         vec.z());
  SkeletonPose moved;
  moved.root_in_world_m =
      mean.root_in_world_m + world_from_heading * Vector3d(tail[3], tail[0], tail[4]);
  moved.world_from_root = (turn * mean.world_from_root).normalized();
  moved.dofs = mean.dofs + difference.head<kNumAngles>();
  return moved;
}

}  // namespace poselift
