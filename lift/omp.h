// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift/constant_rows.h"
#include "lift/sparse_code.h"

namespace poselift {

// Orthogonal matching pursuit, (P1a) of the sparse coding paper:
//
//   min_x |A_p x - v_p|^2 + ridge |x|^2   s.t. |x|_0 <= max_atoms        Eq. (11)
//
// A_p: M x K, the dictionary seen through the projection operator (columns are
// NOT of unit norm any more); v_p: the M observed rows. Each step takes the
// atom that lowers the objective of a single atom most,
//   argmax_k  <a_k, r>^2 / (|a_k|^2 + ridge),
// and solves for all chosen coefficients again (Cholesky, updated by one row).
// The paper has ridge = 0; a ridge keeps an atom that the operator hardly sees
// from being blown up to explain a little of what is seen.
// Cost: max_atoms products M x K, linear in K. Atoms the operator does not see
// at all are never taken.
struct OmpOptions {
  int max_atoms = 8;
  double ridge = 0.0;                  // in the units of |a_k|^2
  double stop_residual_squared = 0.0;  // ends when |A_p x - v_p|^2 is at most this

  std::string Validate() const;  // empty, or which option is wrong and why
};

// Keeps its storage, so that repeated calls of one size allocate nothing but
// the code they return.
class OmpSolver {
 public:
  // atoms: M x K; squared_norms: |a_k|^2 of its columns; target: M. Ends early
  // when no atom can lower the objective by more than rounding. Atoms in the
  // span of the chosen ones are passed over.
  // `constant`, where given, holds further rows under those of atoms and target:
  // the result is that of the stacked problem.
  void Solve(const Eigen::MatrixXd& atoms, const Eigen::VectorXd& squared_norms,
             const Eigen::VectorXd& target, const OmpOptions& options, SparseCode* code,
             ConstantRows* constant = nullptr);

  // |A_p x - v_p|^2 of the last Solve, over all rows.
  double residual_squared() const { return residual_squared_; }

 private:
  // 1 / (|a_k|^2 + ridge), 0 for what the operator does not see.
  void WeighAtoms(const Eigen::VectorXd& squared_norms, double ridge, const ConstantRows* constant);
  // correlation_ from residual_ and the code.
  void Correlate(const Eigen::MatrixXd& atoms, const SparseCode& code, ConstantRows* constant);
  // The atom of most gain, which is not offered again; -1 when none gains more
  // than least_gain.
  int TakeBestAtom(double least_gain);
  // False when the atom lies in the span of the chosen ones.
  bool AppendToCholesky(const Eigen::MatrixXd& atoms, const std::vector<int>& chosen, int atom,
                        double ridge, ConstantRows* constant);

  Eigen::VectorXd atom_weight_;
  Eigen::VectorXd correlation_;  // <a_k, r>
  Eigen::VectorXd residual_;     // of the rows of atoms
  Eigen::VectorXd target_dot_;   // <a_k, v> of the chosen
  Eigen::MatrixXd cholesky_;     // lower factor of the chosen atoms' Gram matrix
  Eigen::VectorXd gram_row_;
  double residual_squared_ = 0.0;
};

// One call, with its own storage.
SparseCode OrthogonalMatchingPursuit(const Eigen::MatrixXd& atoms, const Eigen::VectorXd& target,
                                     const OmpOptions& options);

}  // namespace poselift
