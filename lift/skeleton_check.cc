// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/skeleton_check.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

namespace poselift {
namespace {

constexpr double kLargestLimit = 1e3;  // radians or metres
constexpr double kTolerance = 1e-6;    // of rotations
constexpr size_t kMostDofs = 6;

bool IsRotation(const Eigen::Matrix3d& matrix) {
  return AllWithin(matrix * matrix.transpose() - Eigen::Matrix3d::Identity(), kTolerance) &&
         matrix.determinant() > 0.0;
}

// A limit may be absent, on its own side.
bool AreLimits(const Dof& dof) {
  const bool lower_ok = std::abs(dof.lower) <= kLargestLimit || dof.lower == -HUGE_VAL;
  const bool upper_ok = std::abs(dof.upper) <= kLargestLimit || dof.upper == HUGE_VAL;
  return lower_ok && upper_ok && dof.lower <= dof.upper;
}

std::string DofFlaw(const Bone& bone, size_t most_dofs) {
  if (bone.dofs.size() > most_dofs)
    return fmt::format("bone {} has {} degrees of freedom, wanted at most {}", bone.name,
                       bone.dofs.size(), most_dofs);
  for (const Dof& dof : bone.dofs)
    if (!AreLimits(dof))
      return fmt::format(
          "bone {} has a degree of freedom from {:g} to {:g}, wanted limits in "
          "order and at most {:g}",
          bone.name, dof.lower, dof.upper, kLargestLimit);
  return "";
}

std::string BoneFlaw(int index, const Bone& bone) {
  const JointInfo& joint = Joints()[index];
  if (bone.name != joint.cmu_bone)
    return fmt::format("bone {} is not the wanted {}", index, joint.cmu_bone);
  if (bone.parent != joint.parent)
    return fmt::format("bone {} has parent {}, wanted {}", bone.name, bone.parent, joint.parent);
  if (!AllWithin(bone.offset_m, kLargestLength_m) || !AllWithin(bone.tip_m, kLargestLength_m))
    return fmt::format("bone {} has an offset or a tip beyond {:g} m", bone.name, kLargestLength_m);
  if (!IsRotation(bone.rest_from_axis))
    return fmt::format("bone {} has an axis frame that is no rotation", bone.name);
  return DofFlaw(bone, index == joint::kPelvis ? 0 : kMostDofs);
}

}  // namespace

std::string SkeletonFlaw(const Skeleton& skeleton) {
  if (skeleton.bones.size() != kNumJoints)
    return fmt::format("the skeleton has {} bones, wanted {}", skeleton.bones.size(), kNumJoints);
  for (int b = 0; b < kNumJoints; ++b)
    if (std::string flaw = BoneFlaw(b, skeleton.bones[b]); !flaw.empty()) return flaw;
  return "";
}

}  // namespace poselift
