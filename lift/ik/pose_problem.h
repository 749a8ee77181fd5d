// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "lift/ik/pose_costs.h"

namespace ceres {
class Manifold;
class Problem;
}  // namespace ceres

namespace poselift {

enum class IkStatus {
  kNotRun,
  kConverged,
  kMaxIterations,  // usable, perhaps not the best
  kBadInput,       // too few points, or absurd ones: there is no pose
  kFailed          // the solver broke down: there is no pose
};

// "converged", "bad input", ...
const char* IkStatusName(IkStatus status);

// True when there is a pose to use.
bool IsUsable(IkStatus status);

struct PoseProblemOutcome {
  IkStatus status = IkStatus::kNotRun;
  std::string message;
  int iterations = 0;
};

// One pose (and perhaps a camera) as the unknowns of a sum of terms, within
// the limits of its dofs:
//   min_q  sum_k 1/2 |r_k(q)|^2   with   lower <= dofs <= upper
// by Ceres' Levenberg-Marquardt. The limits are an active set around it: Ceres
// minimises with the springs alone, dofs that end outside are held at their
// limit, those whose gradient leads back inside are let go, and again; the best
// pose within the limits is the answer, so never a worse one than the start.
// (The bounds of Ceres itself project each step of all unknowns, which stalls
// when several limits are active: measured twice as slow, and short of the
// minimum in half of all captured frames.)
//
// The articulation must outlive it. Runs on the calling thread, says nothing
// on stderr.
class PoseProblem {
 public:
  PoseProblem(const Articulation& body, const SkeletonPose& start, const DofSprings& springs);
  ~PoseProblem();
  PoseProblem(const PoseProblem&) = delete;
  PoseProblem& operator=(const PoseProblem&) = delete;

  // Terms of root, rotation and dofs, and of the camera as well. Beyond `cauchy` standard
  // deviations, of all its rows together, a term counts less and less; 0: never.
  void AddPoseTerm(std::unique_ptr<ceres::CostFunction> term, double cauchy = 0.0);
  void AddCameraTerm(std::unique_ptr<ceres::CostFunction> term);
  void AddDofsTerm(std::unique_ptr<ceres::CostFunction> term);
  // The root stays where the start has it.
  void HoldRootPosition();

  // Done when a step lowers the cost by less than function_tolerance times it.
  PoseProblemOutcome Solve(int max_iterations, double function_tolerance);

  // How sure the pose is where it is now: the inverse of the Gauss-Newton matrix by the
  // root's position, a small turn w of it in world, Exp(w) R, and the dofs,
  // (6 + D) x (6 + D). Limits are not counted. Empty where it is singular, and when a
  // term cannot be evaluated.
  Eigen::MatrixXd Covariance();

  double Cost();  // of the terms where the pose is now

  const SkeletonPose& pose() const { return pose_; }
  // log(scale_px_per_m), translation_px. Set before solving, read after.
  Eigen::Vector3d& camera() { return camera_; }

 private:
  PoseProblemOutcome Minimize(int max_iterations, double function_tolerance);
  bool HoldOutsideDofs();
  bool ReleaseInsideDofs();
  void ApplyHeld();

  SkeletonPose pose_;
  Eigen::Vector3d camera_ = Eigen::Vector3d::Zero();
  DofSprings springs_;
  // A dof that was let go and came outside again is kept: no endless change.
  enum class Hold { kFree, kHeld, kReleased, kKept };
  std::vector<Hold> holds_;  // of each dof
  std::vector<std::unique_ptr<ceres::Manifold>> manifolds_;
  std::unique_ptr<ceres::Problem> problem_;
};

}  // namespace poselift
