// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/joints.h"

namespace poselift {

const std::array<JointInfo, kNumJoints>& Joints() {
  static constexpr std::array<JointInfo, kNumJoints> kJoints = {{
      {"pelvis", "root", -1, 0},           {"left_hip", "lhipjoint", 0, 5},
      {"left_knee", "lfemur", 1, 6},       {"left_ankle", "ltibia", 2, 7},
      {"left_foot", "lfoot", 3, 8},        {"right_hip", "rhipjoint", 0, 1},
      {"right_knee", "rfemur", 5, 2},      {"right_ankle", "rtibia", 6, 3},
      {"right_foot", "rfoot", 7, 4},       {"lower_back", "lowerback", 0, 9},
      {"upper_back", "upperback", 9, 10},  {"thorax", "thorax", 10, 11},
      {"lower_neck", "lowerneck", 11, 12}, {"upper_neck", "upperneck", 12, 13},
      {"head_top", "head", 13, 14},        {"left_shoulder", "lclavicle", 11, 19},
      {"left_elbow", "lhumerus", 15, 20},  {"left_wrist", "lradius", 16, 21},
      {"left_hand", "lwrist", 17, 22},     {"right_shoulder", "rclavicle", 11, 15},
      {"right_elbow", "rhumerus", 19, 16}, {"right_wrist", "rradius", 20, 17},
      {"right_hand", "rwrist", 21, 18},
  }};
  return kJoints;
}

std::optional<int> FindJoint(std::string_view name) {
  if (name == "neck") return joint::kThorax;
  if (name == "head") return joint::kHeadTop;
  for (int j = 0; j < kNumJoints; ++j)
    if (Joints()[j].name == name) return j;
  return std::nullopt;
}

std::span<const std::span<const int>> JointChains() {
  static constexpr std::array<int, 5> kLeftLeg = {0, 1, 2, 3, 4};
  static constexpr std::array<int, 5> kRightLeg = {0, 5, 6, 7, 8};
  static constexpr std::array<int, 7> kTorso = {0, 9, 10, 11, 12, 13, 14};
  static constexpr std::array<int, 5> kLeftArm = {11, 15, 16, 17, 18};
  static constexpr std::array<int, 5> kRightArm = {11, 19, 20, 21, 22};
  static constexpr std::array<std::span<const int>, 5> kChains = {kLeftLeg, kRightLeg, kTorso,
                                                                  kLeftArm, kRightArm};
  return kChains;
}

}  // namespace poselift
