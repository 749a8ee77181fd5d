// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/joints.h"

#include "src/translated.h"

namespace poselift {

const std::array<JointInfo, kNumJoints>& Joints() {
  static constexpr std::array<JointInfo, kNumJoints> kJoints = {{
      {ToTranslate("pelvis"), "root", -1, 0},
      {ToTranslate("left_hip"), "lhipjoint", 0, 5},
      {ToTranslate("left_knee"), "lfemur", 1, 6},
      {ToTranslate("left_ankle"), "ltibia", 2, 7},
      {ToTranslate("left_foot"), "lfoot", 3, 8},
      {ToTranslate("right_hip"), "rhipjoint", 0, 1},
      {ToTranslate("right_knee"), "rfemur", 5, 2},
      {ToTranslate("right_ankle"), "rtibia", 6, 3},
      {ToTranslate("right_foot"), "rfoot", 7, 4},
      {ToTranslate("lower_back"), "lowerback", 0, 9},
      {ToTranslate("upper_back"), "upperback", 9, 10},
      {ToTranslate("thorax"), "thorax", 10, 11},
      {ToTranslate("lower_neck"), "lowerneck", 11, 12},
      {ToTranslate("upper_neck"), "upperneck", 12, 13},
      {ToTranslate("head_top"), "head", 13, 14},
      {ToTranslate("left_shoulder"), "lclavicle", 11, 19},
      {ToTranslate("left_elbow"), "lhumerus", 15, 20},
      {ToTranslate("left_wrist"), "lradius", 16, 21},
      {ToTranslate("left_hand"), "lwrist", 17, 22},
      {ToTranslate("right_shoulder"), "rclavicle", 11, 15},
      {ToTranslate("right_elbow"), "rhumerus", 19, 16},
      {ToTranslate("right_wrist"), "rradius", 20, 17},
      {ToTranslate("right_hand"), "rwrist", 21, 18},
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
