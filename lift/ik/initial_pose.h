// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift/ik/articulation.h"
#include "src/forward_kinematics.h"

namespace poselift {

// A cold start for inverse kinematics, near enough to the target that the
// solver needs few steps and no arm ends bent backwards:
//   1. the root by Kabsch on the hips, which are rigid with it, and the trunk;
//   2. bone by bone outwards, the dofs that point a bone at its joints. Where
//      a hinge follows (knee, elbow), its axis is also turned to the normal of
//      the plane of the two bones, which settles the twist. Within the limits,
//      which tells apart the two sets of three angles that turn alike.
class InitialPose {
 public:
  explicit InitialPose(const Articulation& body);

  // body: the constructor's. weights: 23, zero where the target has no joint.
  // What the target does not show stays as in from_dofs.
  SkeletonPose Find(const Articulation& body, const DofLimits& limits,
                    const Pose3& target_in_world_m, const Eigen::VectorXd& weights,
                    const Eigen::VectorXd& from_dofs) const;

 private:
  // A joint that is rigid with a bone.
  struct Handle {
    int joint;
    Eigen::Vector3d point_in_bone_m;
  };
  // A bone with one rotation that starts at a handle.
  struct Hinge {
    int near_joint;                // at the hinge
    int far_joint;                 // behind it
    Eigen::Vector3d axis_in_bone;  // the hinge bends about it by positive angles
  };
  // A unit vector in a bone and where the target wants it in world.
  struct Aim {
    Eigen::Vector3d in_bone;
    Eigen::Vector3d in_world;
    double weight;
  };

  void AddHandles(const Articulation& body);
  void AddHinges(const Articulation& body);
  SkeletonPose AlignRoot(const Articulation& body, const Pose3& target_m,
                         const Eigen::VectorXd& weights, const Eigen::VectorXd& dofs) const;
  std::vector<Aim> AimsOf(int bone, const Eigen::Vector3d& start_m, const Pose3& target_m,
                          const Eigen::VectorXd& weights) const;

  // One bone with its place, its aims and the range of its dofs.
  struct Turn {
    const Bone& bone;
    Eigen::Matrix3d world_from_parent;
    std::vector<Aim> aims;
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;
  };
  static Eigen::VectorXd BestDofs(const Turn& turn, const Eigen::VectorXd& from);
  static double TurnFrom(const Turn& turn, const Eigen::VectorXd& from, Eigen::VectorXd* dofs);

  std::vector<std::vector<Handle>> handles_;  // of each bone
  std::vector<std::vector<Hinge>> hinges_;
};

}  // namespace poselift
