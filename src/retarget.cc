// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/retarget.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "src/dof_angles.h"

namespace poselift {
namespace {

constexpr double kNoLength_m = 1e-9;

Eigen::Matrix3d TargetFromSourceRest(const Bone& source, const Bone& target) {
  if (source.parent < 0 || target.parent < 0 || source.tip_m.norm() < kNoLength_m ||
      target.tip_m.norm() < kNoLength_m)
    return Eigen::Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(source.tip_m, target.tip_m).toRotationMatrix();
}

bool HasShifts(const Bone& bone) {
  for (const Dof& dof : bone.dofs)
    if (!dof.IsRotation()) return true;
  return false;
}

}  // namespace

Rebaser::Rebaser(const Skeleton& source, const Skeleton& target, std::vector<int> source_of_target)
    : source_(source),
      target_(target),
      source_of_target_(std::move(source_of_target)),
      source_starts_(source.DofStarts()),
      world_from_target_(target.bones.size()),
      pose_(SkeletonPose::Rest(target)) {
  for (size_t b = 0; b < target_.bones.size(); ++b) {
    const int s = source_of_target_[b];
    target_from_source_.push_back(s < 0 ? Eigen::Matrix3d::Identity()
                                        : TargetFromSourceRest(source_.bones[s], target_.bones[b]));
    if (s < 0 && !target_.bones[b].dofs.empty())
      report_.bones_at_rest.push_back(target_.bones[b].name);
    if (s >= 0 && b > 0) ++report_.num_matched;
  }
}

const SkeletonPose& Rebaser::Rebase(const SkeletonPose& pose) {
  ForwardKinematics(source_, pose, &source_frames_);
  pose_.root_in_world_m = pose.root_in_world_m;
  pose_.world_from_root = source_frames_.world_from_bone[0];
  world_from_target_[0] = source_frames_.world_from_bone[0];
  int next_dof = 0;
  for (size_t b = 1; b < target_.bones.size(); ++b) {
    PoseBone(b, pose, pose_.dofs.data() + next_dof);
    next_dof += static_cast<int>(target_.bones[b].dofs.size());
  }
  ++num_poses_;
  return pose_;
}

void Rebaser::PoseBone(size_t b, const SkeletonPose& source_pose, double* values) {
  const Bone& bone = target_.bones[b];
  const Eigen::Matrix3d& world_from_parent = world_from_target_[bone.parent];
  const int s = source_of_target_[b];
  if (s < 0) {
    world_from_target_[b] = world_from_parent;
    return;
  }
  const Eigen::Matrix3d& C = bone.rest_from_axis;
  const Eigen::Matrix3d wanted =
      source_frames_.world_from_bone[s] * target_from_source_[b].transpose();
  const Eigen::Matrix3d rotation = C.transpose() * world_from_parent.transpose() * wanted * C;
  const double error_rad = FitDofAngles(rotation, bone.dofs, values);
  world_from_target_[b] = world_from_parent * C * RotationOfDofs(bone.dofs, values) * C.transpose();
  if (error_rad > report_.worst_rotation_rad) {
    report_.worst_rotation_rad = error_rad;
    report_.worst_bone = bone.name;
    report_.worst_frame = num_poses_;
  }
  ShiftBone(b, source_pose, values);
}

void Rebaser::ShiftBone(size_t b, const SkeletonPose& source_pose, double* values) {
  const Bone& bone = target_.bones[b];
  const int s = source_of_target_[b];
  const Bone& source_bone = source_.bones[s];
  if (source_bone.parent < 0 || (!HasShifts(source_bone) && !HasShifts(bone))) return;
  Eigen::Vector3d shift_in_source_axis_m = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < source_bone.dofs.size(); ++i)
    if (!source_bone.dofs[i].IsRotation())
      shift_in_source_axis_m[source_bone.dofs[i].Axis()] +=
          source_pose.dofs[source_starts_[s] + static_cast<int>(i)];
  const Eigen::Vector3d shift_in_world_m = source_frames_.world_from_bone[source_bone.parent] *
                                           source_bone.rest_from_axis * shift_in_source_axis_m;
  Eigen::Vector3d left_m =
      (world_from_target_[bone.parent] * bone.rest_from_axis).transpose() * shift_in_world_m;
  for (size_t i = 0; i < bone.dofs.size(); ++i) {
    if (bone.dofs[i].IsRotation()) continue;
    values[i] = left_m[bone.dofs[i].Axis()];
    left_m[bone.dofs[i].Axis()] = 0.0;
  }
  report_.worst_shift_m = std::max(report_.worst_shift_m, left_m.norm());
}

std::vector<int> MatchBonesByName(const Skeleton& source, const Skeleton& target) {
  std::vector<int> source_of_target;
  for (const Bone& bone : target.bones) {
    const int found = source.FindBone(bone.name).value_or(-1);
    // Root goes to root alone.
    source_of_target.push_back(bone.parent < 0 ? 0 : found == 0 ? -1 : found);
  }
  return source_of_target;
}

Motion RebaseMotion(const Motion& source, const Skeleton& target,
                    const std::vector<int>& source_of_target, RebaseReport* report) {
  Motion rebased{target, source.frame_time_s, {}};
  rebased.frames.reserve(source.frames.size());
  Rebaser rebaser(source.skeleton, target, source_of_target);
  for (const SkeletonPose& pose : source.frames) rebased.frames.push_back(rebaser.Rebase(pose));
  if (report) *report = rebaser.report();
  return rebased;
}

Motion RebaseMotion(const Motion& source, const Skeleton& target, RebaseReport* report) {
  return RebaseMotion(source, target, MatchBonesByName(source.skeleton, target), report);
}

}  // namespace poselift
