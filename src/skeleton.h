// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/joints.h"

namespace poselift {

// One degree of freedom of a bone: a rotation about, or a shift along, an axis
// of the bone's own axis frame. Limits in radians or metres.
struct Dof {
  enum class Kind { kRx, kRy, kRz, kTx, kTy, kTz };
  Kind kind = Kind::kRx;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();

  bool IsRotation() const { return kind <= Kind::kRz; }
  int Axis() const { return static_cast<int>(kind) % 3; }  // 0 x, 1 y, 2 z
};

// A rigid bone. With G the rotation world_from_bone of a bone and p its parent:
//   start   = start_p + G_p (offset + C t)          t: shifts of its dofs
//   G       = G_p  C R C^T                          C: rest_from_axis
//   R       = R(dof_n-1) ... R(dof_0)               the ASF order: first dof innermost
//   tip     = start + G tip
// At rest (all dofs zero) every bone frame is parallel to the world.
struct Bone {
  std::string name;
  int parent = -1;                                               // always before its children
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();            // from the parent's start
  Eigen::Vector3d tip_m = Eigen::Vector3d::Zero();               // from this bone's start
  Eigen::Matrix3d rest_from_axis = Eigen::Matrix3d::Identity();  // ASF `axis`
  std::vector<Dof> dofs;
};

// A tree of bones. Bone 0 is the root: its motion is the position and rotation
// of the SkeletonPose, it has no dofs of its own.
struct Skeleton {
  std::string name;
  std::vector<Bone> bones;

  int NumDofs() const;
  // Index of the first dof of each bone in SkeletonPose::dofs.
  std::vector<int> DofStarts() const;
  std::optional<int> FindBone(std::string_view name) const;  // ignores case
};

// A skeleton's configuration at one time.
struct SkeletonPose {
  Eigen::Vector3d root_in_world_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond world_from_root = Eigen::Quaterniond::Identity();
  Eigen::VectorXd dofs;  // radians or metres, bone by bone

  static SkeletonPose Rest(const Skeleton& skeleton);
};

// Where each of the 23 joints sits on a skeleton: the start or the tip of a
// bone, or nowhere (bone -1).
struct JointSite {
  int bone = -1;
  bool at_tip = true;
};
using JointSites = std::array<JointSite, kNumJoints>;

// Finds the joints by name: the CMU bones of an ASF, else the usual BVH names
// (Hips, LeftUpLeg, ...; mixamorig: and the like are ignored).
JointSites FindJointSites(const Skeleton& skeleton);

// The trim of the paper: the bones of a CMU skeleton that end at the 23 joints
// and their 46 degrees of freedom (6 of the root, 40 of the joints). The
// clavicles' four are dropped: they are zero in every CMU frame.
// Throws InputError when a bone is missing.
Skeleton TrimToJoints(const Skeleton& cmu_skeleton);

}  // namespace poselift
