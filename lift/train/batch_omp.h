// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

namespace poselift {

// The sparse codes of many poses over one dictionary: column j of a pose matrix
// is the sum over i < sizes[j] of coefficients(i, j) * atom atoms(i, j).
struct SparseCodes {
  Eigen::MatrixXi atoms;         // kappa x m
  Eigen::MatrixXd coefficients;  // kappa x m
  Eigen::VectorXi sizes;         // m
};

// OMP of every column of poses (D x m) over a dictionary with columns of unit
// norm (D x n), |x_j|_0 <= sparsity: the coding step of Eq. (3). Batch form
// (Rubinstein, Zibulevsky and Elad 2008): with G = A^T A known, a step costs
// O(n) and the residual is never formed. Equals OmpSolver with ridge 0.
SparseCodes BatchOmp(const Eigen::MatrixXd& atoms, const Eigen::MatrixXd& poses, int sparsity);

// |Y - A X|^2 of each column: m.
Eigen::VectorXd CodingErrors(const Eigen::MatrixXd& atoms, const Eigen::MatrixXd& poses,
                             const SparseCodes& codes);

}  // namespace poselift
