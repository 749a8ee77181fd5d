// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/forward_kinematics.h"

#include <cmath>
#include <limits>

namespace poselift {
namespace {

// R <- Rot(axis, angle) R, touching only the two rows that change.
void RotateRows(int axis, double angle, Eigen::Matrix3d* rotation) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Eigen::RowVector3d row_u = rotation->row(u);
  rotation->row(u) = c * row_u - s * rotation->row(v);
  rotation->row(v) = s * row_u + c * rotation->row(v);
}

// The axis of each dof in world: the dofs behind it (applied after it) turn it.
Eigen::Matrix3Xd AxesInWorld(const Skeleton& skeleton, const std::vector<int>& dof_starts,
                             const SkeletonPose& pose, const BoneFrames& frames) {
  Eigen::Matrix3Xd axes_in_world(3, pose.dofs.size());
  for (size_t b = 0; b < skeleton.bones.size(); ++b) {
    const Bone& bone = skeleton.bones[b];
    Eigen::Matrix3d world_from_parent = pose.world_from_root.toRotationMatrix();
    if (bone.parent >= 0) world_from_parent = frames.world_from_bone[bone.parent];
    Eigen::Matrix3d outer = world_from_parent * bone.rest_from_axis;
    for (int i = static_cast<int>(bone.dofs.size()) - 1; i >= 0; --i) {
      const int d = dof_starts[b] + i;
      const Dof& dof = bone.dofs[i];
      if (dof.IsRotation()) {
        axes_in_world.col(d) = outer.col(dof.Axis());
        outer = outer * Eigen::AngleAxisd(pose.dofs[d], Eigen::Vector3d::Unit(dof.Axis())).matrix();
      } else {
        axes_in_world.col(d) = (world_from_parent * bone.rest_from_axis).col(dof.Axis());
      }
    }
  }
  return axes_in_world;
}

// dx/dq of a point fixed to a bone, 3 rows that are zero on entry.
template <typename Rows>
void DifferentiatePoint(const Skeleton& skeleton, const std::vector<int>& dof_starts,
                        const Eigen::Matrix3Xd& axes_in_world, const SkeletonPose& pose,
                        const BoneFrames& frames, int bone_of_point, const Eigen::Vector3d& x,
                        Rows rows) {
  rows.template leftCols<3>().setIdentity();
  const Eigen::Vector3d from_root = x - pose.root_in_world_m;
  for (int k = 0; k < 3; ++k) rows.col(3 + k) = Eigen::Vector3d::Unit(k).cross(from_root);
  // A rotation moves what lies behind its bone's start; a point at a bone's
  // start is not moved by that bone's rotations, and the cross product is 0.
  for (int b = bone_of_point; b >= 0; b = skeleton.bones[b].parent) {
    const Bone& bone = skeleton.bones[b];
    const Eigen::Vector3d from_start = x - frames.start_in_world_m.col(b);
    for (size_t i = 0; i < bone.dofs.size(); ++i) {
      const int d = dof_starts[b] + static_cast<int>(i);
      const Eigen::Vector3d axis = axes_in_world.col(d);
      rows.col(6 + d) = bone.dofs[i].IsRotation() ? axis.cross(from_start) : axis;
    }
  }
}

}  // namespace

void PlaceBone(const Skeleton& skeleton, int b, int first_dof, const SkeletonPose& pose,
               BoneFrames* frames) {
  const Bone& bone = skeleton.bones[b];
  Eigen::Matrix3d rotation_in_axis = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift_in_axis_m = Eigen::Vector3d::Zero();
  Eigen::Index d = first_dof;
  for (const Dof& dof : bone.dofs) {
    if (dof.IsRotation())
      RotateRows(dof.Axis(), pose.dofs[d], &rotation_in_axis);
    else
      shift_in_axis_m[dof.Axis()] += pose.dofs[d];
    ++d;
  }
  const Eigen::Matrix3d& C = bone.rest_from_axis;
  const Eigen::Matrix3d parent_from_bone = C * rotation_in_axis * C.transpose();
  if (bone.parent < 0) {
    frames->world_from_bone[b] = pose.world_from_root.toRotationMatrix() * parent_from_bone;
    frames->start_in_world_m.col(b) = pose.root_in_world_m;
  } else {
    const Eigen::Matrix3d& world_from_parent = frames->world_from_bone[bone.parent];
    frames->world_from_bone[b] = world_from_parent * parent_from_bone;
    frames->start_in_world_m.col(b) = frames->start_in_world_m.col(bone.parent) +
                                      world_from_parent * (bone.offset_m + C * shift_in_axis_m);
  }
  frames->tip_in_world_m.col(b) =
      frames->start_in_world_m.col(b) + frames->world_from_bone[b] * bone.tip_m;
}

void ForwardKinematics(const Skeleton& skeleton, const SkeletonPose& pose, BoneFrames* frames) {
  const int num_bones = static_cast<int>(skeleton.bones.size());
  frames->world_from_bone.resize(skeleton.bones.size());
  frames->start_in_world_m.resize(3, num_bones);
  frames->tip_in_world_m.resize(3, num_bones);
  int first_dof = 0;
  for (int b = 0; b < num_bones; ++b) {
    PlaceBone(skeleton, b, first_dof, pose, frames);
    first_dof += static_cast<int>(skeleton.bones[b].dofs.size());
  }
}

Pose3 JointPositions(const JointSites& sites, const BoneFrames& frames) {
  Pose3 joints(3, kNumJoints);
  for (int j = 0; j < kNumJoints; ++j) {
    if (sites[j].bone < 0)
      joints.col(j).setConstant(std::numeric_limits<double>::quiet_NaN());
    else
      joints.col(j) = sites[j].at_tip ? frames.tip_in_world_m.col(sites[j].bone)
                                      : frames.start_in_world_m.col(sites[j].bone);
  }
  return joints;
}

Pose3 JointPositions(const Skeleton& skeleton, const SkeletonPose& pose) {
  BoneFrames frames;
  ForwardKinematics(skeleton, pose, &frames);
  return JointPositions(FindJointSites(skeleton), frames);
}

void JointJacobian(const Skeleton& skeleton, const JointSites& sites, const SkeletonPose& pose,
                   const BoneFrames& frames, Eigen::MatrixXd* jacobian) {
  jacobian->setZero(3 * kNumJoints, 6 + pose.dofs.size());
  const std::vector<int> dof_starts = skeleton.DofStarts();
  const Eigen::Matrix3Xd axes_in_world = AxesInWorld(skeleton, dof_starts, pose, frames);
  for (int j = 0; j < kNumJoints; ++j) {
    if (sites[j].bone < 0) continue;
    const Eigen::Vector3d x = sites[j].at_tip ? frames.tip_in_world_m.col(sites[j].bone)
                                              : frames.start_in_world_m.col(sites[j].bone);
    DifferentiatePoint(skeleton, dof_starts, axes_in_world, pose, frames, sites[j].bone, x,
                       jacobian->middleRows<3>(3 * j));
  }
}

void FrameJacobian(const Skeleton& skeleton, int bone, const Eigen::Vector3d& x_in_world_m,
                   const SkeletonPose& pose, const BoneFrames& frames, Eigen::MatrixXd* jacobian) {
  jacobian->setZero(6, 6 + pose.dofs.size());
  const std::vector<int> dof_starts = skeleton.DofStarts();
  const Eigen::Matrix3Xd axes_in_world = AxesInWorld(skeleton, dof_starts, pose, frames);
  DifferentiatePoint(skeleton, dof_starts, axes_in_world, pose, frames, bone, x_in_world_m,
                     jacobian->topRows<3>());
  jacobian->block<3, 3>(3, 3).setIdentity();
  for (int b = bone; b >= 0; b = skeleton.bones[b].parent)
    for (size_t i = 0; i < skeleton.bones[b].dofs.size(); ++i) {
      const int d = dof_starts[b] + static_cast<int>(i);
      if (skeleton.bones[b].dofs[i].IsRotation())
        jacobian->col(6 + d).tail<3>() = axes_in_world.col(d);
    }
}

}  // namespace poselift
