// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "src/forward_kinematics.h"
#include "src/motion.h"
#include "src/skeleton.h"

namespace poselift {

// What did not fit when a motion was put on another skeleton.
struct RebaseReport {
  // The largest rotation (radians) and shift (metres) of one bone that the
  // dofs of the target cannot express, and where.
  double worst_rotation_rad = 0.0;
  double worst_shift_m = 0.0;
  std::string worst_bone;
  int worst_frame = -1;  // from 0
  // Target bones with dofs that the source has no bone for: they stay at rest.
  std::vector<std::string> bones_at_rest;
  int num_matched = 0;  // bones matched beside the root
};

// For each target bone the source bone of the same name (case ignored), or -1.
// Root goes to root whatever their names.
std::vector<int> MatchBonesByName(const Skeleton& source, const Skeleton& target);

// The same movement on a skeleton with another rest pose, other axes and other
// dofs. With d the rest direction of a bone (its tip) in the source and d' in
// the target, Q is the smallest rotation that takes d to d', and the bone gets
//   G' = G Q^-1       (world_from_bone)        so that G' d' = G d:
// every bone points in the world as it did. The rule needs only the two sets
// of directions, so the way back is exact. Q = I for the root and for bones
// without length. A bone without a source keeps its rest pose on its parent. What a
// bone's dofs cannot express is not passed on to its children. The root's
// position is kept; nothing is scaled.
//
// source_of_target: from MatchBonesByName or the caller's own.
Motion RebaseMotion(const Motion& source, const Skeleton& target,
                    const std::vector<int>& source_of_target, RebaseReport* report = nullptr);
Motion RebaseMotion(const Motion& source, const Skeleton& target, RebaseReport* report = nullptr);

// The same, pose after pose.
class Rebaser {
 public:
  Rebaser(const Skeleton& source, const Skeleton& target, std::vector<int> source_of_target);

  // On the target, angles without jumps to those of the pose before. Valid until the next call.
  const SkeletonPose& Rebase(const SkeletonPose& pose);

  const RebaseReport& report() const { return report_; }  // of all poses so far

 private:
  void PoseBone(size_t b, const SkeletonPose& source_pose, double* values);
  void ShiftBone(size_t b, const SkeletonPose& source_pose, double* values);

  const Skeleton source_, target_;
  const std::vector<int> source_of_target_;
  const std::vector<int> source_starts_;
  RebaseReport report_;
  std::vector<Eigen::Matrix3d> target_from_source_;
  int num_poses_ = 0;
  BoneFrames source_frames_;
  std::vector<Eigen::Matrix3d> world_from_target_;
  SkeletonPose pose_;
};

}  // namespace poselift
