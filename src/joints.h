// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace poselift {

// The skeleton of the sparse coding paper (figure 2): 23 joints, numbered here
// from 0 (the paper's ID minus one). A joint is the end of one bone of the CMU
// skeleton; toes, fingers, thumbs and hands beyond the wrist bone are trimmed.
inline constexpr int kNumJoints = 23;

struct JointInfo {
  std::string_view name;
  std::string_view cmu_bone;  // the CMU bone that ends at the joint
  int parent;                 // -1 for the pelvis
  int mirror;                 // the joint of the other side; itself on the midline
};

const std::array<JointInfo, kNumJoints>& Joints();

// Index of a joint by name; "neck" and "head" stand for thorax and head_top.
std::optional<int> FindJoint(std::string_view name);

// The five chains of Algorithm 1 (legs, torso with head, arms), root first.
std::span<const std::span<const int>> JointChains();

namespace joint {
inline constexpr int kPelvis = 0, kLeftHip = 1, kLeftKnee = 2, kLeftAnkle = 3, kLeftFoot = 4,
                     kRightHip = 5, kRightKnee = 6, kRightAnkle = 7, kRightFoot = 8, kLowerBack = 9,
                     kUpperBack = 10, kThorax = 11, kLowerNeck = 12, kUpperNeck = 13, kHeadTop = 14,
                     kLeftShoulder = 15, kLeftElbow = 16, kLeftWrist = 17, kLeftHand = 18,
                     kRightShoulder = 19, kRightElbow = 20, kRightWrist = 21, kRightHand = 22;
}  // namespace joint

}  // namespace poselift
