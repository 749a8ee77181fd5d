// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/motion_curves.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

#include "lift/ik/articulation.h"
#include "src/dof_angles.h"

namespace poselift {
namespace {

constexpr Eigen::Index kRootChannels = 7;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;
// Shorter than this a filtered quaternion has no direction.
constexpr double kNoDirection = 1e-9;

bool TurnsAboutThreeAxes(const Bone& bone) {
  int rotations = 0;
  bool turns_about[3] = {false, false, false};
  for (const Dof& dof : bone.dofs)
    if (dof.IsRotation()) {
      ++rotations;
      turns_about[dof.Axis()] = true;
    }
  return rotations == 3 && turns_about[0] && turns_about[1] && turns_about[2];
}

Eigen::Vector4d ToChannels(const Eigen::Quaterniond& q) {
  return 2.0 * Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).normalized();
}

Eigen::Quaterniond ToQuaternion(const Eigen::Vector4d& channels,
                                const Eigen::Quaterniond& otherwise) {
  const double length = channels.norm();
  if (length < kNoDirection) return otherwise;
  return {channels[0] / length, channels[1] / length, channels[2] / length, channels[3] / length};
}

}  // namespace

MotionCurves::MotionCurves(const Motion& motion)
    : skeleton_(motion.skeleton),
      frame_time_s_(motion.frame_time_s),
      first_known_(SkeletonPose::Rest(motion.skeleton)) {
  curves_.setConstant(LayChannels(), static_cast<Eigen::Index>(motion.frames.size()),
                      std::numeric_limits<double>::quiet_NaN());
  Eigen::VectorXd before;
  for (Eigen::Index t = 0; t < curves_.cols(); ++t) {
    const SkeletonPose& pose = motion.frames[static_cast<size_t>(t)];
    if (!IsKnown(pose)) continue;
    if (before.size() == 0) first_known_ = pose;
    before = ColumnOf(pose, before);
    curves_.col(t) = before;
  }
  FindRanges();
}

Eigen::Index MotionCurves::LayChannels() {
  Eigen::Index next = kRootChannels;
  int first_dof = 0;
  for (size_t b = 0; b < skeleton_.bones.size(); ++b) {
    const Bone& bone = skeleton_.bones[b];
    const auto num_dofs = static_cast<Eigen::Index>(bone.dofs.size());
    const bool is_ball = TurnsAboutThreeAxes(bone);
    if (num_dofs > 0) bones_.push_back({static_cast<int>(b), first_dof, is_ball, next});
    next += is_ball ? num_dofs + 1 : num_dofs;
    first_dof += static_cast<int>(num_dofs);
  }
  return next;
}

// before: the column of the frame before; empty when there is none.
Eigen::VectorXd MotionCurves::ColumnOf(const SkeletonPose& pose,
                                       const Eigen::VectorXd& before) const {
  Eigen::VectorXd column(curves_.rows());
  const bool is_first = before.size() == 0;
  const auto put_rotation = [&](Eigen::Index channel, const Eigen::Quaterniond& q) {
    column.segment<4>(channel) = ToChannels(q);
    if (!is_first && column.segment<4>(channel).dot(before.segment<4>(channel)) < 0.0)
      column.segment<4>(channel) *= -1.0;
  };
  column.head<3>() = pose.root_in_world_m;
  put_rotation(3, pose.world_from_root);
  for (const BoneChannels& channels : bones_) {
    const std::vector<Dof>& dofs = skeleton_.bones[channels.bone].dofs;
    const double* values = pose.dofs.data() + channels.first_dof;
    Eigen::Index channel = channels.first_channel;
    if (channels.is_ball) {
      put_rotation(channel, Eigen::Quaterniond(RotationOfDofs(dofs, values)));
      channel += 4;
    }
    for (size_t d = 0; d < dofs.size(); ++d) {
      if (channels.is_ball && dofs[d].IsRotation()) continue;
      column[channel] = values[d];
      if (!is_first && dofs[d].IsRotation())
        column[channel] += kTurn_rad * std::round((before[channel] - values[d]) / kTurn_rad);
      ++channel;
    }
  }
  return column;
}

SkeletonPose MotionCurves::PoseOf(const Eigen::VectorXd& column, const SkeletonPose& before) const {
  SkeletonPose pose = before;
  pose.root_in_world_m = column.head<3>();
  pose.world_from_root = ToQuaternion(column.segment<4>(3), before.world_from_root);
  for (const BoneChannels& channels : bones_) {
    const std::vector<Dof>& dofs = skeleton_.bones[channels.bone].dofs;
    double* values = pose.dofs.data() + channels.first_dof;
    Eigen::Index channel = channels.first_channel;
    if (channels.is_ball) {
      const Eigen::Quaterniond otherwise(RotationOfDofs(dofs, values));
      const Eigen::Quaterniond rotation = ToQuaternion(column.segment<4>(channel), otherwise);
      FitDofAngles(rotation.toRotationMatrix(), dofs, values);
      channel += 4;
    }
    for (size_t d = 0; d < dofs.size(); ++d)
      if (!channels.is_ball || !dofs[d].IsRotation()) values[d] = column[channel++];
  }
  return pose;
}

// The limits, or as far outside as this motion is.
void MotionCurves::FindRanges() {
  const DofLimits limits(Articulation(skeleton_), true);
  lowest_ = limits.lower;
  highest_ = limits.upper;
  SkeletonPose pose = first_known_;
  for (Eigen::Index t = 0; t < curves_.cols(); ++t) {
    if (curves_.col(t).hasNaN()) continue;
    pose = PoseOf(curves_.col(t), pose);
    lowest_ = lowest_.cwiseMin(pose.dofs);
    highest_ = highest_.cwiseMax(pose.dofs);
  }
}

Motion MotionCurves::ToMotion(const Eigen::MatrixXd& curves) const {
  if (curves.rows() != curves_.rows() || curves.cols() != curves_.cols())
    throw std::invalid_argument("MotionCurves: the curves have another size than the motion's");
  Motion motion{skeleton_, frame_time_s_, {}};
  motion.frames.assign(static_cast<size_t>(curves.cols()), UnknownPose(skeleton_));
  SkeletonPose pose = first_known_;
  for (Eigen::Index t = 0; t < curves.cols(); ++t) {
    if (curves.col(t).hasNaN()) continue;
    pose = PoseOf(curves.col(t), pose);
    SkeletonPose& within = motion.frames[static_cast<size_t>(t)];
    within = pose;
    within.dofs = pose.dofs.cwiseMax(lowest_).cwiseMin(highest_);
  }
  return motion;
}

}  // namespace poselift
