// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/body_transfer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "src/dof_angles.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kNoLength_m = 1e-9;

Eigen::Matrix3d RotationAt(const BodyMap::Between& place, const std::vector<Eigen::Matrix3d>& of) {
  if (place.IsOneBone()) return of[place.from];
  return Eigen::Quaterniond(of[place.from])
      .slerp(place.share, Eigen::Quaterniond(of[place.to]))
      .toRotationMatrix();
}

Eigen::Matrix3d SmallestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  if (from.norm() < kNoLength_m || to.norm() < kNoLength_m) return Eigen::Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

// From the hips to the ankles, both legs.
double LegLength_m(const Skeleton& skeleton, int left_thigh, int left_shank, int right_thigh,
                   int right_shank) {
  BoneFrames rest;
  ForwardKinematics(skeleton, SkeletonPose::Rest(skeleton), &rest);
  double length_m = 0.0;
  for (const auto& [thigh, shank] :
       {std::pair(left_thigh, left_shank), std::pair(right_thigh, right_shank)})
    length_m += (rest.start_in_world_m.col(shank) - rest.start_in_world_m.col(thigh)).norm() +
                skeleton.bones[shank].tip_m.norm();
  return length_m;
}

Eigen::Matrix3d WorldFromBone(const Bone& bone, const Eigen::Matrix3d& world_from_parent,
                              const double* values) {
  const Eigen::Matrix3d& C = bone.rest_from_axis;
  return world_from_parent * C * RotationOfDofs(bone.dofs, values) * C.transpose();
}

// The angles that turn the bone to an orientation in the world, nearest to those
// of `values`; returns the orientation that it gets.
Eigen::Matrix3d TurnBone(const Bone& bone, const Eigen::Matrix3d& world_from_parent,
                         const Eigen::Matrix3d& world_from_bone, double* values) {
  const Eigen::Matrix3d& C = bone.rest_from_axis;
  FitDofAngles(C.transpose() * world_from_parent.transpose() * world_from_bone * C, bone.dofs,
               values);
  return WorldFromBone(bone, world_from_parent, values);
}

// How far the dofs are beyond their limits, radians.
double Excess(const Bone& bone, const double* values) {
  double excess = 0.0;
  for (size_t i = 0; i < bone.dofs.size(); ++i)
    excess += std::max({0.0, bone.dofs[i].lower - values[i], values[i] - bone.dofs[i].upper});
  return excess;
}

// As TurnBone, but where that goes far beyond the limits, angles that are the same
// and nearest to rest are better: a wrong frame, or many turns, led astray.
Eigen::Matrix3d TurnBodyBone(const Bone& bone, const Eigen::Matrix3d& world_from_parent,
                             const Eigen::Matrix3d& world_from_bone, double* values) {
  constexpr double kAstray_rad = 0.1;
  const Eigen::Matrix3d turned = TurnBone(bone, world_from_parent, world_from_bone, values);
  if (Excess(bone, values) < kAstray_rad) return turned;
  std::vector<double> from_rest(bone.dofs.size(), 0.0);
  const Eigen::Matrix3d near_rest =
      TurnBone(bone, world_from_parent, world_from_bone, from_rest.data());
  if (Excess(bone, from_rest.data()) >= Excess(bone, values)) return turned;
  std::copy(from_rest.begin(), from_rest.end(), values);
  return near_rest;
}

}  // namespace

BodyTransfer::BodyTransfer(Skeleton source, Skeleton body)
    : source_(std::move(source)),
      body_(std::move(body)),
      map_(FindBody(source_)),
      source_dofs_(source_.DofStarts()),
      body_dofs_(body_.DofStarts()) {
  if (!map_.flaw.empty())
    throw InputError(source_.name, map_.flaw + ", wanted the skeleton of a body");
  const auto source_of = [&](int joint) { return map_.source_of_body[joint].from; };
  scale_ = LegLength_m(body_, joint::kLeftKnee, joint::kLeftAnkle, joint::kRightKnee,
                       joint::kRightAnkle) /
           LegLength_m(source_, source_of(joint::kLeftKnee), source_of(joint::kLeftAnkle),
                       source_of(joint::kRightKnee), source_of(joint::kRightAnkle));
  const Eigen::Matrix3d& A = map_.body_from_source;
  for (int j = 0; j < kNumJoints; ++j) {
    const BodyMap::Between& place = map_.source_of_body[j];
    source_from_body_[j] = A.transpose();
    if (j != joint::kPelvis && place.IsKnown() && place.IsOneBone())
      source_from_body_[j] *=
          SmallestRotation(A * source_.bones[place.from].tip_m, body_.bones[j].tip_m).transpose();
  }
}

Motion BodyTransfer::ToBody(const Motion& motion) const {
  Motion on_body{body_, motion.frame_time_s, {}};
  SkeletonPose pose = SkeletonPose::Rest(body_);
  BoneFrames source;
  for (const SkeletonPose& frame : motion.frames) {
    if (!IsKnown(frame)) {
      on_body.frames.push_back(UnknownPose(body_));
      continue;
    }
    ForwardKinematics(source_, frame, &source);
    PoseBody(source, &pose);
    on_body.frames.push_back(pose);
  }
  return on_body;
}

// pose: on entry that of the frame before.
void BodyTransfer::PoseBody(const BoneFrames& source, SkeletonPose* pose) const {
  const Eigen::Matrix3d& A = map_.body_from_source;
  pose->root_in_world_m = scale_ * A * source.start_in_world_m.col(map_.pelvis);
  Rotations world_from_bone(body_.bones.size());
  world_from_bone[0] = A * source.world_from_bone[map_.pelvis] * source_from_body_[0];
  pose->world_from_root = world_from_bone[0];
  for (size_t b = 1; b < body_.bones.size(); ++b) {
    const Bone& bone = body_.bones[b];
    const BodyMap::Between& place = map_.source_of_body[b];
    world_from_bone[b] = world_from_bone[bone.parent];
    if (place.IsKnown())
      world_from_bone[b] =
          TurnBodyBone(bone, world_from_bone[bone.parent],
                       A * RotationAt(place, source.world_from_bone) * source_from_body_[b],
                       pose->dofs.data() + body_dofs_[b]);
  }
}

Motion BodyTransfer::CarryBack(const Motion& motion, const Motion& after) const {
  if (motion.frames.size() != after.frames.size())
    throw std::invalid_argument("BodyTransfer: the motions have another number of frames");
  const Motion before = ToBody(motion);
  Motion carried{source_, motion.frame_time_s, {}};
  for (size_t t = 0; t < motion.frames.size(); ++t) {
    const bool is_known = IsKnown(motion.frames[t]) && IsKnown(after.frames[t]);
    carried.frames.push_back(
        is_known ? CarryPoseBack(motion.frames[t], before.frames[t], after.frames[t])
                 : UnknownPose(source_));
  }
  return carried;
}

SkeletonPose BodyTransfer::CarryPoseBack(const SkeletonPose& pose, const SkeletonPose& before,
                                         const SkeletonPose& after) const {
  const Eigen::Matrix3d& A = map_.body_from_source;
  BoneFrames frames, frames_before, frames_after;
  ForwardKinematics(source_, pose, &frames);
  ForwardKinematics(body_, before, &frames_before);
  ForwardKinematics(body_, after, &frames_after);
  Rotations turns;  // of the body's bones, in the source's world
  for (size_t b = 0; b < body_.bones.size(); ++b)
    turns.emplace_back(A.transpose() * frames_after.world_from_bone[b] *
                       frames_before.world_from_bone[b].transpose() * A);
  SkeletonPose carried = pose;
  Rotations world_from_bone;
  for (size_t b = 0; b < source_.bones.size(); ++b) {
    const Bone& bone = source_.bones[b];
    const BodyMap::Between& place = map_.body_of_source[b];
    Eigen::Matrix3d wanted = frames.world_from_bone[b];
    if (place.IsKnown()) wanted = RotationAt(place, turns) * wanted;
    double* dofs = carried.dofs.data() + source_dofs_[b];
    if (bone.parent >= 0)
      wanted = place.IsKnown() ? TurnBone(bone, world_from_bone[bone.parent], wanted, dofs)
                               : WorldFromBone(bone, world_from_bone[bone.parent], dofs);
    world_from_bone.push_back(wanted);
  }
  carried.world_from_root = world_from_bone[0];
  const Eigen::Vector3d moved_m =
      A.transpose() * (after.root_in_world_m - before.root_in_world_m) / scale_;
  PutPelvis(frames.start_in_world_m.col(map_.pelvis) + moved_m, &carried);
  return carried;
}

// By the pelvis' own shifts where it has all three, else by the root.
void BodyTransfer::PutPelvis(const Eigen::Vector3d& place_in_world_m, SkeletonPose* pose) const {
  BoneFrames frames;
  ForwardKinematics(source_, *pose, &frames);
  const Eigen::Vector3d move_m = place_in_world_m - frames.start_in_world_m.col(map_.pelvis);
  const Bone& bone = source_.bones[map_.pelvis];
  const auto num_shifts = std::count_if(bone.dofs.begin(), bone.dofs.end(),
                                        [](const Dof& dof) { return !dof.IsRotation(); });
  if (bone.parent < 0 || num_shifts < 3) {
    pose->root_in_world_m += move_m;
    return;
  }
  const Eigen::Vector3d move_in_axis_m =
      (frames.world_from_bone[bone.parent] * bone.rest_from_axis).transpose() * move_m;
  for (size_t i = 0; i < bone.dofs.size(); ++i)
    if (!bone.dofs[i].IsRotation())
      pose->dofs[source_dofs_[map_.pelvis] + static_cast<int>(i)] +=
          move_in_axis_m[bone.dofs[i].Axis()];
}

}  // namespace poselift
