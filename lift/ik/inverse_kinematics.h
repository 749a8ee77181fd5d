// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lift/ik/articulation.h"
#include "lift/ik/initial_pose.h"
#include "lift/ik/pose_problem.h"
#include "src/observation.h"
#include "src/pose3.h"
#include "src/skeleton.h"

namespace poselift {

struct IkOptions {
  // Keep every dof within its limits (Dof::lower, Dof::upper). Captured motion
  // leaves the limits of its ASF file often: in six of ten frames of the CMU
  // database, mostly at feet, neck and upper arms. Set it to false to
  // reproduce such poses exactly.
  bool enforce_limits = true;
  // The pull of the dofs to rest: one radian off costs as much as one joint
  // off by this. It settles what joint positions cannot show (the twist of a
  // straight limb or of the head, how the spine's bones share a turn) and must
  // stay well below the accuracy wanted.
  double pull_m_per_rad = 1e-3;
  int max_iterations = 100;
  // Done when a step lowers the cost by less than this part of it.
  double function_tolerance = 1e-5;

  // Empty when all is well, else what is wrong.
  std::string Validate() const;
};

struct IkResult {
  IkStatus status = IkStatus::kNotRun;
  std::string message = "inverse kinematics was not run";
  SkeletonPose pose;  // to be used if IsUsable(status)
  int iterations = 0;
  // Distance of f(q) to the target over the joints that count.
  double rms_m = -1.0;
  double max_m = -1.0;

  std::string BriefReport() const;
};

// What a caller may know beside the target. All optional.
struct IkHints {
  // A weight >= 0 for each of the 23 joints, best about 1; empty: all 1.
  Eigen::VectorXd joint_weights;
  // Where to start: for a sequence, the pose of the frame before.
  std::optional<SkeletonPose> start;
  // Where the weak pull leads; else to zero, the rest pose.
  std::optional<Eigen::VectorXd> rest_dofs;
  // Tags, in the target's world. A joint of weight 1 counts as one known to 1 m.
  std::vector<ObservedBonePose> bone_poses = {};
};

// Inverse kinematics, the problem (P2), Eq. (14) and (15), of the sparse
// coding paper: the pose q whose joints f(q) are the normalised target y,
//   min_q  sum_j w_j |f_j(q) - y_j|^2 + tags + pull^2 |dofs - rest|^2,
//   lower <= dofs <= upper,
// over the root's position and rotation and the dofs. Angles never leave their
// start by full turns: solves that start from each other are continuous in
// time.
class InverseKinematics {
 public:
  // Throws InputError when the options are invalid or the skeleton has no dofs.
  explicit InverseKinematics(Skeleton skeleton, const IkOptions& options = {});

  // target_in_world_m: 3 x 23, any frame; a joint with a coordinate that is
  // not finite is absent. At least three joints must be there, no farther
  // apart than a few times the body's size. Several threads may call at once;
  // the answer is a function of the arguments alone. Hints of the wrong size,
  // not finite or negative throw std::invalid_argument.
  IkResult Solve(const Pose3& target_in_world_m, const IkHints& hints = {}) const;

  const Articulation& body() const { return body_; }
  const IkOptions& options() const { return options_; }

 private:
  void CheckSizes(const Pose3& target_in_world_m, const IkHints& hints) const;
  SkeletonPose Start(const Pose3& target_m, const Eigen::VectorXd& weights,
                     const DofSprings& springs, const IkHints& hints) const;

  Articulation body_;
  IkOptions options_;
  DofLimits limits_;
  InitialPose initial_pose_;
  double reach_m_;  // from the root along the longest chain of bones
};

}  // namespace poselift
