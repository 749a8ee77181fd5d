// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift/dictionary.h"
#include "lift/omp.h"
#include "lift/projection_operator.h"
#include "lift/rotation.h"
#include "lift/view_search.h"
#include "src/observation.h"

namespace poselift {

// (P1) of the sparse coding paper, with a prior on the pose:
//
//   min_{x, tau, s}  |P{tau o (A x)} - y_0|^2 + |W (tau - tau_0)|^2
//                    + prior_weight^2 |whitening (A x - mean)|^2
//   s.t. |x|_0 <= max_atoms, s > 0                                     Eq. (7)
//
// by alternating OMP on the masked rows (P1a), with the rows of the prior under
// them, the rotation (P1b) and the scale, from several views. prior_weight = 0
// is the paper's problem; x and s then share one factor.
struct LifterOptions {
  OmpOptions omp{.max_atoms = 20};
  RotationOptions rotation{.prior_weight = {2.5, 0.0, 2.5}};  // 23 degrees of tilt are one sigma
  ViewSearchOptions views;
  double prior_weight = 1.0;
  int max_alternations = 15;
  double min_improvement = 1e-3;  // relative, of the objective
  // By how much OMP's new atoms must be better than the old ones refitted: a part of the objective.
  double new_atoms_gain = 0.0;
  // After this many alternations only the best finish.
  int trial_alternations = 2;
  int num_finishing = 4;
  // Two solutions are one when their joints, root-centred in cam, are closer
  // than this (RMS).
  double distinct_m = 0.06;

  std::string Validate() const;
};

// One local minimum of (P1).
struct LiftSolution {
  SparseCode code;                 // x
  Eigen::VectorXd pose_in_body_m;  // A x, 69
  Eigen::Vector3d tau_rad = Eigen::Vector3d::Zero();
  double scale_px_per_m = 1.0;
  double objective = -1.0;
  std::vector<double> history;  // the objective after every step; never rises
  bool converged = false;
};

class Alternation;

class Lifter {
 public:
  // The dictionary must outlive the lifter. Throws std::invalid_argument when
  // the options are invalid.
  Lifter(const Dictionary& dictionary, LifterOptions options);

  // The distinct local minima that were found, the best first; empty when the
  // observation cannot be lifted (see CanLift). With hints, those that break some are
  // tried again with limbs, or all, mirrored in depth.
  std::vector<LiftSolution> Solve(const Observation& observation) const;

  // The alternation from given starts, each to convergence; for tests and for
  // starts known otherwise.
  std::vector<LiftSolution> SolveFrom(const Observation& observation,
                                      const std::vector<ViewStart>& starts) const;

  // The alternation to convergence from a solution of another observation, which can be
  // lifted: its code too is where it starts.
  LiftSolution GoOnFrom(const Observation& observation, LiftSolution start) const;

  // One alternation from a solution of about the same observation, which can be lifted; atoms
  // change only where that is clearly better. For points that are dragged: each answer goes on from
  // the one before, and a pose whose points hardly move does not either.
  LiftSolution Follow(const Observation& observation, LiftSolution start) const;

 private:
  void AddMirrored(const Observation& observation, Alternation* alternation,
                   std::vector<LiftSolution>* solutions) const;

  const Dictionary& dictionary_;
  LifterOptions options_;
  Eigen::MatrixXd prior_rows_;    // prior_weight whitening A: 69 x K, or 0 x K
  Eigen::VectorXd prior_target_;  // prior_weight whitening mean
};

// Empty, or why these points do not determine a pose: fewer than four, all in
// one place, or numbers that are none or beyond any picture.
std::string CanLift(const Observation& observation);

}  // namespace poselift
