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
//   knees, ankles, elbows,   D = Rx Rz Ry: flexion about the parent's x, side
//   wrists, spine            bend or inversion, then rotation about the child's
//                            own y, as Grood and Suntay (1983)
//   hips, shoulders          D = Exp(sx, 0, sz) Ry(t): the swing of the limb as
//                            one rotation vector (flexion, abduction), then the
//                            turn about its length. With the limb raised
//                            sideways by 90 an Euler sequence would be in gimbal
//                            lock; this one is only with the limb straight up.
//   pelvis                   S = Ry Rz Rx: rotation, obliquity, tilt (Baker 2001)
// The same movement has the same sign on both sides: flexion, abduction,
// rotation inward, dorsiflexion, inversion and pronation are positive. A CMU foot
// has two dofs only: its inversion follows from the other two.
struct JointAngle {
  std::string name;      // "left_elbow.flexion"
  std::string positive;  // the movement that makes it grow
};

const std::vector<JointAngle>& JointAngles();

bool IsOfLimb(const JointAngle& angle);  // of an arm or a leg; else of pelvis, spine, neck or head

class JointAngleReader {
 public:
  // Throws InputError when the skeleton lacks a bone of the CMU skeleton.
  explicit JointAngleReader(const Skeleton& skeleton);

  // One value for each of JointAngles(), degrees. y is up in world.
  Eigen::VectorXd ReadDeg(const SkeletonPose& pose) const;

  // The same, of all equal answers the one nearest to the frame before: no
  // jumps of 360 degrees. Angles of a whole turn and more are possible.
  Eigen::VectorXd ReadDeg(const SkeletonPose& pose, const Eigen::VectorXd& previous_deg) const;

  // d ReadDeg / d (w, dofs), angles x (3 + D), degrees per radian, where w turns the
  // root in world: Exp(w) world_from_root. By central differences.
  Eigen::MatrixXd DerivativeDeg(const SkeletonPose& pose) const;

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
