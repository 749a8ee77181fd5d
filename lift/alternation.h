// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

#include "lift/lifter.h"

namespace poselift {

// The problem (P1) of one observation, ready for its steps: the atoms as the
// operator sees them, the rows of the prior, and the storage that all starts
// share.
class Alternation {
 public:
  Alternation(const Dictionary& dictionary, const LifterOptions& options,
              const Observation& observation, const Eigen::MatrixXd& prior_rows,
              const Eigen::VectorXd& prior_target);

  const ProjectionOperator& op() const { return op_; }
  const Eigen::MatrixXd& centred_atoms() const { return centred_atoms_; }

  // Alternates until convergence or max_alternations times from where the
  // solution stands; no step lets its objective rise.
  void Run(int max_alternations, LiftSolution* solution);

  // Gives a solution that has angles and scale this code to go on from.
  void StartFrom(SparseCode code, LiftSolution* solution);

 private:
  void UpdateCode(LiftSolution* solution);      // (P1a)
  void UpdateRotation(LiftSolution* solution);  // (P1b)
  void UpdateScale(LiftSolution* solution);

  // The terms of the objective that the code alone decides: prior and ridge.
  double CodeCost(const SparseCode& code) const;
  // The whole objective of a code under the rows and angles as they stand.
  double Objective(const SparseCode& code, const Eigen::Vector3d& tau_rad) const;
  // OMP over the rows as they stand, of the bounds those that the answer would break.
  SparseCode BestCode(const Eigen::Vector3d& tau_rad);
  void Refit(SparseCode* code);
  // Leaves the rows of bounds in active_rows_ that the residual breaks.
  void KeepActive(const Eigen::ArrayXd& active);

  const Dictionary& dictionary_;
  const LifterOptions& options_;
  ProjectionOperator op_;
  Eigen::MatrixXd centred_atoms_;  // 3 points x K
  Eigen::MatrixXd rows_;           // A_p as it was last seen: NumRows x K
  Eigen::MatrixXd active_rows_;    // the same without bounds that hold, if there are any
  Eigen::VectorXd active_target_;
  ConstantRows prior_;
  OmpSolver omp_;
};

}  // namespace poselift
