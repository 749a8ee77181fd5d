// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lift/ik/articulation.h"
#include "lift/pose_prior.h"
#include "src/layout.h"
#include "src/observation.h"

namespace ceres {
class CostFunction;
}

namespace poselift {

// The terms of the pose synthesis problem (P0), Eq. (4), that depend on the
// pose q through f(q), the joints of forward kinematics, as Ceres cost
// functions with analytic Jacobians. A solver adds up the terms it wants (see
// PoseProblem). Their parameter blocks, in this order:
//   root_in_world_m   3
//   world_from_root   4   unit quaternion x y z w, as Eigen stores it
//   dofs              D   radians or metres, as in SkeletonPose
//   camera            3   log(scale_px_per_m), translation_px; 2D points only
// A cost keeps a reference to the articulation, which must outlive it, and is
// for one thread at a time.

// A point of the body, the sum over its parts of weight times joint, and where
// it should be: metres in world, or px (the third coordinate is not read).
struct TargetPoint {
  std::vector<Landmark::Part> parts;  // joints that the skeleton has
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  double root_weight = 1.0;  // the square root of the weight: 1 / sigma
};

// root_weight_i (m_i f(q) - x_i), 3 rows a point, then the residuals of tags
// (observation.h; cam is the world), 3 rows of place each, then 3 of rotation.
// With up_to_translation the weighted mean of the differences of place is taken off
// each: that is the best common shift, solved for exactly. Throws
// std::invalid_argument for a tag on a bone that the skeleton lacks, or whose poses
// or sigmas are none.
std::unique_ptr<ceres::CostFunction> MakeSpaceCost(
    const Articulation& body, std::vector<TargetPoint> points, bool up_to_translation,
    const std::vector<ObservedBonePose>& bone_poses = {});

// root_weight_i (s (m_i f(q))_xy + t - x_i), 2 rows a point: the weak
// perspective camera; the pose's world is `cam`.
std::unique_ptr<ceres::CostFunction> MakeReprojectionCost(const Articulation& body,
                                                          std::vector<TargetPoint> points);

// JointRelation::Residual of f(q), a row each; the pose's world is `cam`, and the skeleton
// has all their joints.
std::unique_ptr<ceres::CostFunction> MakeRelationCost(const Articulation& body,
                                                      std::vector<JointRelation> relations);

// whitening (f_0(dofs) - mean), 69 rows: how uncommon the pose is to the prior,
// which must outlive the cost. f_0: the joints with the root at rest (the body
// frame), all 23. Its only parameter block is the dofs.
std::unique_ptr<ceres::CostFunction> MakePriorCost(const Articulation& body,
                                                   const PosePrior& prior);

// A spring on each dof: weak within the limits, stiff outside.
struct DofSprings {
  DofLimits limits;
  Eigen::VectorXd rest;    // D, within the limits
  double pull = 0.0;       // residual per radian (or metre) from rest
  double stiffness = 0.0;  // residual per radian (or metre) beyond a limit
};

// pull (q_d - rest_d) + stiffness (q_d - clamp(q_d, lower_d, upper_d)), D rows.
// Its only parameter block is the dofs.
std::unique_ptr<ceres::CostFunction> MakeSpringCost(const DofSprings& springs);

}  // namespace poselift
