// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "src/pose3.h"
#include "src/skeleton.h"

namespace poselift {

// Rotation and position of every bone (see Bone for the equations).
struct BoneFrames {
  std::vector<Eigen::Matrix3d> world_from_bone;
  Eigen::Matrix3Xd start_in_world_m;  // 3 x B
  Eigen::Matrix3Xd tip_in_world_m;    // 3 x B
};

// The frame of a bone: its rotation, its start.
inline Eigen::Isometry3d WorldFromBone(const BoneFrames& frames, int bone) {
  Eigen::Isometry3d world_from_bone = Eigen::Isometry3d::Identity();
  world_from_bone.linear() = frames.world_from_bone[static_cast<size_t>(bone)];
  world_from_bone.translation() = frames.start_in_world_m.col(bone);
  return world_from_bone;
}

// Reuses the storage of *frames: no allocation after the first call.
void ForwardKinematics(const Skeleton& skeleton, const SkeletonPose& pose, BoneFrames* frames);

// The step of ForwardKinematics for one bone whose parent has its frame. The
// bone's dofs start at first_dof; *frames has its sizes.
void PlaceBone(const Skeleton& skeleton, int bone, int first_dof, const SkeletonPose& pose,
               BoneFrames* frames);

// f(q): the 23 joints, in world, metres; NaN where the skeleton lacks a joint.
Pose3 JointPositions(const JointSites& sites, const BoneFrames& frames);
Pose3 JointPositions(const Skeleton& skeleton, const SkeletonPose& pose);

// J = df/dq, 3*23 x (6 + NumDofs): columns are the root's position (3), a
// small rotation of the root in world, R = Exp(w) R0 (3), then the dofs.
// Rows of absent joints are zero.
void JointJacobian(const Skeleton& skeleton, const JointSites& sites, const SkeletonPose& pose,
                   const BoneFrames& frames, Eigen::MatrixXd* jacobian);

// The same of a frame fixed to a bone, its origin at x, 6 x (6 + NumDofs): rows
// are the origin (3) and a small rotation of the frame in world (3).
void FrameJacobian(const Skeleton& skeleton, int bone, const Eigen::Vector3d& x_in_world_m,
                   const SkeletonPose& pose, const BoneFrames& frames, Eigen::MatrixXd* jacobian);

}  // namespace poselift
