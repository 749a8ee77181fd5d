// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/pose_handles.h"

#include <algorithm>
#include <array>

#include "src/joint_relation.h"

namespace poselift {
namespace {

using namespace joint;  // NOLINT(google-build-using-namespace)

constexpr double kAtOnePlace = 0.35;  // of the reach

bool AreSame(const std::vector<Landmark::Part>& a, const std::vector<Landmark::Part>& b) {
  return std::ranges::equal(a, b, [](const Landmark::Part& x, const Landmark::Part& y) {
    return x.joint == y.joint && x.weight == y.weight;
  });
}

int ParentOf(int joint) { return Joints()[static_cast<size_t>(joint)].parent; }

}  // namespace

std::vector<PoseHandle> PoseHandles(const Layout& layout) {
  std::vector<PoseHandle> handles;
  for (int j = 0; j < kNumJoints; ++j) {
    PoseHandle handle{.name = std::string(Joints()[static_cast<size_t>(j)].name), .joint = j};
    handle.parts = PartsNamed(handle.name, layout);
    if (handle.parts.size() == 1) handle.joint = handle.parts.front().joint;
    const bool is_new = std::ranges::none_of(
        handles, [&](const PoseHandle& other) { return AreSame(other.parts, handle.parts); });
    if (is_new) handles.push_back(std::move(handle));
  }
  return handles;
}

std::optional<size_t> HitHandle(const std::vector<PoseHandle>& handles,
                                const Pose3& joints_in_cam_m, const Projection& projection,
                                const Eigen::Vector2d& x_px, double reach_px) {
  std::optional<size_t> hit;
  double least = 0.0;
  for (size_t h = 0; h < handles.size(); ++h) {
    const Eigen::Vector3d at = projection(handles[h].In(joints_in_cam_m));
    const double distance_px = (at.head<2>() - x_px).norm();
    if (!(distance_px <= reach_px)) continue;
    // A body's thickness of depth counts as much as what is called one place.
    const double cost =
        distance_px + kAtOnePlace * reach_px * at.z() / (0.2 * projection.scale_px_per_m);
    if (hit && !(cost < least)) continue;
    hit = h;
    least = cost;
  }
  return hit;
}

bool HangsOn(int joint, int other) {
  for (int j = ParentOf(joint); j >= 0; j = ParentOf(j))
    if (j == other) return true;
  return false;
}

std::vector<int> LimbUpTo(int joint) {
  constexpr std::array kBegins = {kPelvis, kLeftHip, kRightHip, kLeftShoulder, kRightShoulder};
  std::vector<int> limb;
  for (int j = joint; std::ranges::count(kBegins, j) == 0; j = ParentOf(j)) limb.push_back(j);
  return limb;
}

}  // namespace poselift
