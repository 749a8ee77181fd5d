// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/bvh_rig.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <string_view>

#include "src/io/text_scanner.h"

namespace poselift {
namespace {

bool IsNamed(const Bone& bone, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (EqualsIgnoringCase(bone.name, name)) return true;
  return false;
}

// Where the bone points in the T-pose, when that is the same for everybody.
std::optional<Eigen::Vector3d> FixedTPoseDirection(const Bone& bone) {
  if (IsNamed(bone, {"lfemur", "ltibia", "rfemur", "rtibia"})) return -Eigen::Vector3d::UnitY();
  if (IsNamed(bone, {"lhumerus", "lradius", "lwrist", "lhand", "lfingers"}))
    return Eigen::Vector3d::UnitX();
  if (IsNamed(bone, {"rhumerus", "rradius", "rwrist", "rhand", "rfingers"}))
    return -Eigen::Vector3d::UnitX();
  return std::nullopt;
}

bool IsFoot(const Bone& bone) { return IsNamed(bone, {"lfoot", "ltoes", "rfoot", "rtoes"}); }

Eigen::Matrix3d SmallestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

// Q of every bone.
std::vector<Eigen::Matrix3d> TPoseFromRest(const Skeleton& skeleton) {
  std::vector<Eigen::Matrix3d> rotations(skeleton.bones.size(), Eigen::Matrix3d::Identity());
  const bool is_cmu = skeleton.FindBone("lfemur") && skeleton.FindBone("rhumerus");
  for (size_t b = 1; is_cmu && b < skeleton.bones.size(); ++b) {
    const Bone& bone = skeleton.bones[b];
    if (bone.tip_m.isZero()) continue;
    if (const auto direction = FixedTPoseDirection(bone)) {
      rotations[b] = SmallestRotation(bone.tip_m, *direction);
    } else if (IsFoot(bone)) {
      int shank = bone.parent;
      while (IsFoot(skeleton.bones[shank])) shank = skeleton.bones[shank].parent;
      rotations[b] = SmallestRotation(bone.tip_m, rotations[shank] * bone.tip_m);
    }
  }
  return rotations;
}

std::vector<bool> FindMelted(const Skeleton& skeleton) {
  std::vector<bool> has_children(skeleton.bones.size(), false);
  for (const Bone& bone : skeleton.bones)
    if (bone.parent >= 0) has_children[bone.parent] = true;
  std::vector<bool> melted;
  for (size_t b = 0; b < skeleton.bones.size(); ++b) {
    const std::string_view name = skeleton.bones[b].name;
    constexpr size_t kSuffix = 5;
    const bool is_joint =
        name.size() > kSuffix && EqualsIgnoringCase(name.substr(name.size() - kSuffix), "joint");
    melted.push_back(b > 0 && is_joint && has_children[b] && skeleton.bones[b].dofs.empty());
  }
  return melted;
}

// The form of BvhWriter: all three shifts or none, then the rotations.
std::vector<Dof> JointDofs(const Bone& bone) {
  if (bone.parent < 0) return {};
  std::vector<Dof> dofs = {{Dof::Kind::kRy}, {Dof::Kind::kRx}, {Dof::Kind::kRz}};
  const bool shifts = std::any_of(bone.dofs.begin(), bone.dofs.end(),
                                  [](const Dof& dof) { return !dof.IsRotation(); });
  if (shifts) dofs.insert(dofs.begin(), {{Dof::Kind::kTx}, {Dof::Kind::kTy}, {Dof::Kind::kTz}});
  return dofs;
}

}  // namespace

BvhRig MakeBvhRig(const Skeleton& skeleton) {
  const std::vector<Eigen::Matrix3d> rotations = TPoseFromRest(skeleton);
  const std::vector<bool> melted = FindMelted(skeleton);
  BvhRig rig;
  rig.skeleton.name = skeleton.name;
  std::vector<int> joint_of_bone;
  std::vector<Eigen::Vector3d> offset_of_melted_m;
  for (size_t b = 0; b < skeleton.bones.size(); ++b) {
    const Bone& bone = skeleton.bones[b];
    Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
    if (bone.parent >= 0) offset_m = bone.offset_m + offset_of_melted_m[bone.parent];
    offset_of_melted_m.push_back(melted[b] ? offset_m : Eigen::Vector3d::Zero().eval());
    if (melted[b]) {
      joint_of_bone.push_back(joint_of_bone[bone.parent]);
      continue;
    }
    Bone joint{.name = bone.name, .tip_m = rotations[b] * bone.tip_m, .dofs = JointDofs(bone)};
    if (bone.parent >= 0) {
      joint.parent = joint_of_bone[bone.parent];
      joint.offset_m = rotations[rig.source_bone[joint.parent]] * offset_m;
    }
    joint_of_bone.push_back(static_cast<int>(rig.skeleton.bones.size()));
    rig.source_bone.push_back(static_cast<int>(b));
    rig.skeleton.bones.push_back(std::move(joint));
  }
  return rig;
}

}  // namespace poselift
