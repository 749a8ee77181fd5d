// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Geometry>
#include <utility>

#include "src/skeleton.h"

namespace poselift {

// Half a turn about x, its own inverse: between the axes of a level camera, cam
// (x right, y down, z forward), and those of a world that it looks into (x right,
// y up, z towards the viewer).
inline const Eigen::Quaterniond kLevelFromCam(0.0, 1.0, 0.0, 0.0);

// A pose from the one to the other, either way.
inline SkeletonPose LevelFromCam(SkeletonPose pose) {
  pose.world_from_root = kLevelFromCam * pose.world_from_root;
  pose.root_in_world_m = kLevelFromCam * pose.root_in_world_m;
  return pose;
}

}  // namespace poselift
