// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/skeleton.h"

#include <algorithm>
#include <cctype>

#include "src/input_error.h"

namespace poselift {
namespace {

std::string Lower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

// Names that BVH rigs give to the bone that starts at a joint (lower case, the
// part behind a prefix such as "mixamorig:").
struct BvhAlias {
  int joint;
  std::vector<std::string_view> names;
};

const std::vector<BvhAlias>& BvhAliases() {
  static const std::vector<BvhAlias> kAliases = {
      {joint::kPelvis, {"hips", "hip", "pelvis", "root"}},
      {joint::kLeftHip, {"leftupleg", "leftthigh", "lthigh", "left_hip", "thigh_l", "lefthip"}},
      {joint::kLeftKnee, {"leftleg", "leftshin", "lshin", "left_knee", "calf_l", "leftknee"}},
      {joint::kLeftAnkle, {"leftankle", "leftfoot", "lfoot", "left_ankle", "foot_l"}},
      {joint::kLeftFoot, {"lefttoebase", "lefttoe", "left_foot", "ball_l"}},
      {joint::kRightHip,
       {"rightupleg", "rightthigh", "rthigh", "right_hip", "thigh_r", "righthip"}},
      {joint::kRightKnee, {"rightleg", "rightshin", "rshin", "right_knee", "calf_r", "rightknee"}},
      {joint::kRightAnkle, {"rightankle", "rightfoot", "rfoot", "right_ankle", "foot_r"}},
      {joint::kRightFoot, {"righttoebase", "righttoe", "right_foot", "ball_r"}},
      {joint::kLowerBack, {"spine", "lower_back", "spine_01"}},
      {joint::kUpperBack, {"spine1", "upper_back", "spine_02"}},
      {joint::kThorax, {"neck", "thorax", "neck_01"}},
      {joint::kLowerNeck, {"neck1", "lower_neck"}},
      {joint::kUpperNeck, {"head", "upper_neck"}},
      {joint::kHeadTop, {"headtop_end", "head_top"}},
      {joint::kLeftShoulder, {"leftarm", "lshldr", "left_shoulder", "upperarm_l", "leftshoulder"}},
      {joint::kLeftElbow, {"leftforearm", "lforearm", "left_elbow", "lowerarm_l", "leftelbow"}},
      {joint::kLeftWrist, {"leftwrist", "lefthand", "lhand", "left_wrist", "hand_l"}},
      {joint::kLeftHand, {"left_hand"}},
      {joint::kRightShoulder,
       {"rightarm", "rshldr", "right_shoulder", "upperarm_r", "rightshoulder"}},
      {joint::kRightElbow, {"rightforearm", "rforearm", "right_elbow", "lowerarm_r", "rightelbow"}},
      {joint::kRightWrist, {"rightwrist", "righthand", "rhand", "right_wrist", "hand_r"}},
      {joint::kRightHand, {"right_hand"}},
  };
  return kAliases;
}

int FindAliased(const Skeleton& skeleton, const BvhAlias& alias) {
  for (const std::string_view wanted : alias.names)
    for (size_t b = 0; b < skeleton.bones.size(); ++b) {
      const std::string name = Lower(skeleton.bones[b].name);
      if (std::string_view(name).substr(name.rfind(':') + 1) == wanted) return static_cast<int>(b);
    }
  return -1;
}

}  // namespace

int Skeleton::NumDofs() const {
  size_t count = 0;
  for (const Bone& bone : bones) count += bone.dofs.size();
  return static_cast<int>(count);
}

std::vector<int> Skeleton::DofStarts() const {
  std::vector<int> starts;
  int next = 0;
  for (const Bone& bone : bones) {
    starts.push_back(next);
    next += static_cast<int>(bone.dofs.size());
  }
  return starts;
}

std::optional<int> Skeleton::FindBone(std::string_view wanted) const {
  const std::string lower = Lower(wanted);
  for (size_t b = 0; b < bones.size(); ++b)
    if (Lower(bones[b].name) == lower) return static_cast<int>(b);
  return std::nullopt;
}

SkeletonPose SkeletonPose::Rest(const Skeleton& skeleton) {
  SkeletonPose pose;
  pose.dofs.setZero(skeleton.NumDofs());
  return pose;
}

JointSites FindJointSites(const Skeleton& skeleton) {
  JointSites sites;
  const bool is_cmu = skeleton.FindBone("lfemur") && skeleton.FindBone("rhumerus");
  for (int j = 0; j < kNumJoints; ++j) {
    if (is_cmu) {
      sites[j] = {skeleton.FindBone(Joints()[j].cmu_bone).value_or(-1), true};
    } else {
      sites[j] = {FindAliased(skeleton, BvhAliases()[j]), false};
    }
  }
  if (is_cmu) {
    sites[joint::kPelvis] = {0, false};
    // A BVH has no hip bones of CMU: the thigh begins where they end.
    for (const int hip : {joint::kLeftHip, joint::kRightHip})
      if (sites[hip].bone < 0) sites[hip] = {sites[hip + 1].bone, false};
  }
  return sites;
}

Skeleton TrimToJoints(const Skeleton& cmu_skeleton) {
  Skeleton trimmed;
  trimmed.name = cmu_skeleton.name;
  for (int j = 0; j < kNumJoints; ++j) {
    const std::string_view name = Joints()[j].cmu_bone;
    const auto found = cmu_skeleton.FindBone(name);
    if (!found)
      throw InputError(cmu_skeleton.name, "found no bone '" + std::string(name) +
                                              "', wanted the bones of a CMU skeleton");
    Bone bone = cmu_skeleton.bones[*found];
    bone.name = name;
    bone.parent = Joints()[j].parent;
    const bool is_clavicle = name == "lclavicle" || name == "rclavicle";
    if (is_clavicle) bone.dofs.clear();
    trimmed.bones.push_back(std::move(bone));
  }
  return trimmed;
}

}  // namespace poselift
