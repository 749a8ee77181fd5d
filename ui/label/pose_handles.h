// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "src/draw/scene.h"
#include "src/layout.h"
#include "src/pose3.h"

namespace poselift {

// What the mouse takes hold of on a pose in space: a joint, under the name that hints know it by.
struct PoseHandle {
  std::string name;
  int joint = 0;                      // of the 23, the one that ends it
  std::vector<Landmark::Part> parts;  // what the name stands for

  Eigen::Vector3d In(const Pose3& joints_m) const { return SumOfJoints(parts, joints_m); }
};

// The pelvis first. A joint that the layout calls by another one's name has no handle of its own:
// body15's wrists are the joints "hand".
std::vector<PoseHandle> PoseHandles(const Layout& layout);

// The handle that a press takes: the nearest within reach, of those at one place the one in front.
std::optional<size_t> HitHandle(const std::vector<PoseHandle>& handles,
                                const Pose3& joints_in_cam_m, const Projection& projection,
                                const Eigen::Vector2d& x_px, double reach_px);

// Whether a joint hangs on another one, farther from the pelvis than it.
bool HangsOn(int joint, int other);

// The joints whose bones bring a joint to its place, it the first: up to where its limb begins,
// behind hip or shoulder, those of the trunk up to the pelvis. None of hips, shoulders and pelvis.
std::vector<int> LimbUpTo(int joint);

}  // namespace poselift
