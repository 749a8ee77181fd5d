// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <limits>
#include <vector>

#include "src/skeleton.h"

namespace poselift {

// A skeleton moving at a fixed rate. A frame of which nothing is known is NaN
// throughout; readers of motion files never return one, writers refuse it.
struct Motion {
  Skeleton skeleton;
  double frame_time_s = 1.0 / 120.0;
  std::vector<SkeletonPose> frames;
};

inline SkeletonPose UnknownPose(const Skeleton& skeleton) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  return {Eigen::Vector3d::Constant(kNaN),
          {kNaN, kNaN, kNaN, kNaN},
          Eigen::VectorXd::Constant(skeleton.NumDofs(), kNaN)};
}

inline bool IsKnown(const SkeletonPose& pose) {
  return pose.root_in_world_m.allFinite() && pose.world_from_root.coeffs().allFinite() &&
         pose.dofs.allFinite();
}

}  // namespace poselift
