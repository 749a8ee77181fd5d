// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "src/motion.h"
#include "src/skeleton.h"

namespace poselift {

// Angles with the names that anatomy gives them, in degrees, read from the
// rotations of a CMU skeleton's bones (whole or trimmed). docs/ANGLES.md.
//
// Zero is standing straight: arms hanging, palms to the thighs, legs straight
// down, feet forward. With S the rotation world_from_segment of a segment, the
// identity in that pose, and D = S_parent^T S_child (x left, y up, z forward):
//   hips, knees, elbows, spine  D = Rx Rz Ry: flexion about the parent's
//                               x, abduction or side bend, then rotation about
//                               the child's own length (Grood and Suntay 1983)
//   ankles                      D = Ry Rx: the foot turns, then flexes; a CMU
//                               foot has these two dofs and no inversion
//   shoulders                   D = Exp(sx, 0, sz) Ry(t): the swing of the arm
//                               as one rotation vector, then the turn about its
//                               length. Raised forwards or sideways by 90 every
//                               Euler sequence has a gimbal lock in arm's reach;
//                               the swing has its one singularity straight up.
//   pelvis                      S = Ry Rz Rx: rotation, obliquity, tilt (Baker 2001)
// The same movement has the same sign on both sides: flexion, abduction,
// internal rotation, dorsiflexion and pronation are positive.
struct JointAngle {
  std::string name;      // "left_elbow.flexion"
  std::string positive;  // the movement that makes it grow
};

const std::vector<JointAngle>& JointAngles();

class JointAngleReader {
 public:
  // Throws InputError when the skeleton lacks a bone of the CMU skeleton.
  explicit JointAngleReader(const Skeleton& skeleton);

  // One value for each of JointAngles(), degrees. y is up in world.
  Eigen::VectorXd ReadDeg(const SkeletonPose& pose) const;

  // The same, of all equal answers the one nearest to the frame before: no
  // jumps of 360 degrees. Angles of a whole turn and more are possible.
  Eigen::VectorXd ReadDeg(const SkeletonPose& pose, const Eigen::VectorXd& previous_deg) const;

 private:
  struct Segment {
    int parent_bone;  // -1: the world
    int child_bone;
    Eigen::Matrix3d parent_in_standing;  // world_from_bone when standing straight
    Eigen::Matrix3d child_in_standing;
  };

  Eigen::VectorXd Read(const SkeletonPose& pose, const Eigen::VectorXd* previous_deg) const;

  Skeleton skeleton_;
  std::vector<Segment> segments_;  // side by side with the table of the source
};

// Angles x frames, degrees, continuous over the frames.
Eigen::MatrixXd ReadJointAnglesDeg(const Motion& motion);

}  // namespace poselift
