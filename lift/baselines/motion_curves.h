// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "src/motion.h"

namespace poselift {

// A motion as curves (curves.h), C x T, that may be filled and filtered channel
// by channel, and the way back. The channels:
//
//   3   the root's position, metres
//   4   2 (w, x, y, z), twice the root's unit quaternion
//   then for each bone that turns about three axes
//   4   2 (w, x, y, z) of its rotation R
//   and of the other dofs
//   1   radians, unwrapped, or metres
//
// Quaternions keep their sign from frame to frame, across gaps too, and are
// normalised on the way back. They are there because filters are linear and so
// is the product with a fixed quaternion: what comes out does not depend on how
// the axes of world or bone were chosen, nothing jumps however often a body
// turns round, and there is no gimbal lock. A turn at an even rate comes out as
// it was: its quaternion runs along a great circle, which a filter without lag
// only makes smaller. A rotation vector jumps at pi; Euler angles close to their
// lock swing by up to pi while the bone hardly turns. The 2 makes a change of
// 1 a radian, for filters whose options have units.
//
// An unknown frame (motion.h) is a column of NaN, and the other way round.
class MotionCurves {
 public:
  explicit MotionCurves(const Motion& motion);

  const Eigen::MatrixXd& curves() const { return curves_; }

  // The motion that other curves of the same size say. Dofs are continuous over
  // time and stay within the skeleton's limits, or as far outside as the
  // constructor's motion was: captured motion often is.
  // Throws std::invalid_argument when the size differs.
  Motion ToMotion(const Eigen::MatrixXd& curves) const;

 private:
  // A bone's dofs and where its channels start.
  struct BoneChannels {
    int bone;
    int first_dof;
    bool is_ball;
    Eigen::Index first_channel;
  };

  Eigen::Index LayChannels();
  Eigen::VectorXd ColumnOf(const SkeletonPose& pose, const Eigen::VectorXd& before) const;
  SkeletonPose PoseOf(const Eigen::VectorXd& column, const SkeletonPose& before) const;
  void FindRanges();

  Skeleton skeleton_;
  double frame_time_s_;
  std::vector<BoneChannels> bones_;
  Eigen::MatrixXd curves_;
  SkeletonPose first_known_;
  Eigen::VectorXd lowest_, highest_;  // of each dof
};

}  // namespace poselift
