// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>

#include "src/motion.h"

namespace poselift {

// A motion of the 23-joint skeleton (TrimToJoints) as numbers that do not depend
// on where the body stands on the floor or which way it faces, one column a
// frame. World y is up. The root's rotation is parted by swing and twist,
//
//   world_from_root = R_yaw R_swing,   R_yaw about y, the axis of R_swing level,
//
// and with p the root's place, dt the frame time, t the frame:
//
//   rows 0..39   angles, radians, continuous over time
//   row  40      height p_y, metres
//   rows 41, 42  tilt: x and z of the rotation vector of R_swing, radians
//   rows 43, 44  x (to the subject's left) and z (forward) of
//                R_yaw(t)^T (p(t) - p(t-1)) / dt, metres per second
//   row  45      (yaw(t) - yaw(t-1)) / dt, the short way round, radians per second
//
// Of the first frame, which has none before it, rows 43..45 are those of the
// second. A root that is upside down (R_swing by pi) has no heading: when one
// passes through, tilt jumps to the other side and yaw may turn quickly. The way
// back is exact there too.
inline constexpr int kNumAngles = 40;
inline constexpr int kNumFeatures = 46;

using FeatureVector = Eigen::Matrix<double, kNumFeatures, 1>;
using FeatureMatrix = Eigen::Matrix<double, kNumFeatures, Eigen::Dynamic>;

namespace feature {
inline constexpr int kHeight = 40, kTilt = 41, kVelocity = 43, kYawRate = 45;
}  // namespace feature

// The angle of R_yaw, radians in [-pi, pi].
double Yaw(const Eigen::Quaterniond& world_from_root);

// What hinders a skeleton to have these features, or "": not 23 bones with 40
// dofs, all of them rotations.
std::string FeatureSkeletonFlaw(const Skeleton& skeleton);

// Rows 0..42 of one pose, the others 0; angles as they are.
FeatureVector PoseFeatures(const SkeletonPose& pose);

// Throws InputError for a skeleton with a FeatureSkeletonFlaw and for a frame time that is not
// positive.
FeatureMatrix MotionFeatures(const Motion& motion);

// The way back, one frame: `before` is the pose of the frame before, of which
// only the root counts.
SkeletonPose PoseFromFeatures(const FeatureVector& features, const SkeletonPose& before,
                              double frame_time_s);

// The features of the motion mirrored left to right, on a skeleton that is its
// own mirror image.
FeatureMatrix MirroredFeatures(const FeatureMatrix& features, const Skeleton& skeleton);

}  // namespace poselift
