// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/layout_edges.h"

#include <array>
#include <optional>

#include "src/joints.h"

namespace poselift {
namespace {

std::optional<int> JointOf(const Landmark& landmark) {
  if (landmark.name == "mid_hip") return joint::kPelvis;
  return FindJoint(landmark.name);
}

}  // namespace

std::vector<std::pair<int, int>> LayoutEdges(const Layout& layout) {
  std::array<int, kNumJoints> landmark_of{};
  landmark_of.fill(-1);
  for (size_t l = 0; l < layout.landmarks.size(); ++l)
    if (const auto j = JointOf(layout.landmarks[l]))
      landmark_of[static_cast<size_t>(*j)] = static_cast<int>(l);
  std::vector<std::pair<int, int>> edges;
  for (int j = 0; j < kNumJoints; ++j) {
    const int landmark = landmark_of[static_cast<size_t>(j)];
    if (landmark < 0) continue;
    int before = Joints()[static_cast<size_t>(j)].parent;
    while (before >= 0 && landmark_of[static_cast<size_t>(before)] < 0)
      before = Joints()[static_cast<size_t>(before)].parent;
    if (before >= 0) edges.emplace_back(landmark_of[static_cast<size_t>(before)], landmark);
  }
  // A trunk without a spine is a box.
  const auto join = [&](int a, int b) {
    if (landmark_of[static_cast<size_t>(a)] >= 0 && landmark_of[static_cast<size_t>(b)] >= 0)
      edges.emplace_back(landmark_of[static_cast<size_t>(a)], landmark_of[static_cast<size_t>(b)]);
  };
  using namespace joint;
  if (landmark_of[kPelvis] >= 0) return edges;
  join(kLeftHip, kRightHip);
  if (landmark_of[kThorax] < 0) join(kLeftShoulder, kRightShoulder);
  join(kLeftHip, kLeftShoulder);
  join(kRightHip, kRightShoulder);
  return edges;
}

}  // namespace poselift
