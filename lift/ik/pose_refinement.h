// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "lift/ik/inverse_kinematics.h"
#include "lift/pose_prior.h"
#include "lift/weak_camera.h"
#include "src/observation.h"
#include "src/pose3.h"

namespace poselift {

struct RefinementOptions {
  // gamma of Eq. (4): 1 / sigma^2 of a coordinate of A x, here 18 cm. Large:
  // the code's pose; small: the labels.
  double gamma_per_m2 = 30.0;
  // How much the pose prior counts; 1: as much as one that is exactly true.
  double prior_weight = 0.4;
  // What one radian from rest weighs beside the other terms, in standard
  // deviations: see IkOptions::pull_m_per_rad.
  double pull_per_rad = 0.02;
  bool enforce_limits = true;
  int max_iterations = 100;
  // Done when a step lowers the cost by less than this part of it.
  double function_tolerance = 1e-6;

  // Empty when all is well, else what is wrong.
  std::string Validate() const;
};

struct RefinementResult {
  IkStatus status = IkStatus::kNotRun;
  std::string message = "pose refinement was not run";
  // All below: to be used if IsUsable(status).
  SkeletonPose pose;        // its world is cam, its root at the origin
  Pose3 joints_in_cam_m;    // f(q): exactly the skeleton's bone lengths
  WeakCamera camera;        // cam_from_body is the pose's root rotation
  bool has_camera = false;  // false without 2D points: scale and translation unknown
  int iterations = 0;
  double code_rms_m = -1.0;           // f(q) to A x
  double reprojection_rms_px = -1.0;  // f(q) to the 2D points; -1 without any

  std::string BriefReport() const;
};

// The pose synthesis problem (P0), Eq. (4), for a fixed code x, over the pose
// q (root rotation and dofs), the scale s and the translation t:
//   min  gamma |y - f(q)|^2                                     the code's y = A x
//      + prior_weight^2 |whitening (f_0(dofs) - mean)|^2        the pose prior
//      + sum_i |s (m_i f(q))_xy + t - x_i_px|^2 / sigma_i^2     2D points
//      + sum_k |m_k f(q) + u - x_k_m|^2 / sigma_k^2             3D points, and tags
//      + sum_r |residual_r(f(q))|^2                              relations of joints (hints)
//      + the weak pull of the dofs to rest,   lower <= dofs <= upper, s > 0.
// f has the skeleton's bone lengths, so that these hold exactly while labels,
// code and prior are traded off. f_0 is f with the root at rest. The code is
// one point and says nothing of how far off it may be in which direction: the
// prior does, which keeps noise of the labels out of the depth. s multiplies the camera and not, as
// printed, the pose: y is in metres. log s is optimised; u, the best shift of the 3D points, is
// eliminated.
class PoseRefinement {
 public:
  // Throws InputError when the options are invalid or the skeleton has no dofs,
  // std::invalid_argument when there is a prior and not every joint it is about.
  explicit PoseRefinement(Skeleton skeleton, const RefinementOptions& options = {},
                          PosePrior prior = {});

  // code_in_cam_m: 3 x 23, pelvis at the origin, already turned into cam (x
  // right, y down, z forward); NaN = no such joint, at least three must be
  // there. Inverse kinematics on it, from `start` if given (a pose in cam), is
  // where the search starts. The observation may lack either kind; 2D points
  // must be two or more, not all at one place. Points that need a joint the
  // skeleton lacks, or are not finite, are left out. Several threads may call
  // at once. Wrong sizes and sigmas throw std::invalid_argument.
  RefinementResult Solve(const Pose3& code_in_cam_m, const Observation& observation,
                         const std::optional<SkeletonPose>& start = std::nullopt) const;

 private:
  InverseKinematics start_ik_;
  PosePrior prior_;
  RefinementOptions options_;
};

}  // namespace poselift
