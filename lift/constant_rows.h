// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <unordered_map>

#include "lift/sparse_code.h"

namespace poselift {

// Rows of an OMP problem that stay as they are while the others change from one
// call to the next: B (M_c x K) and their target b, with M_c and K as large as
// you like, 0 too. In the lifter they are the rows of the pose prior; those of
// the projection operator turn with the camera.
//
// What OMP wants of them, <b_k, residual> for every k, is
//   B^T (b - B x) = B^T b - sum_i x_i B^T b_i,
// so the columns B^T b_i of their Gram matrix are kept from one call to the
// next, and a product M_c x K a step becomes a sum of a few columns of length K.
// Not for several threads at once.
class ConstantRows {
 public:
  ConstantRows(Eigen::MatrixXd rows, Eigen::VectorXd target);

  Eigen::Index num_rows() const { return rows_.rows(); }
  const Eigen::VectorXd& squared_norms() const { return squared_norms_; }  // |b_k|^2: K
  const Eigen::VectorXd& target_dots() const { return target_dots_; }      // B^T b: K
  double target_squared() const { return target_.squaredNorm(); }          // |b|^2

  // B^T b_atom: K. Stays valid until the next call of DropOldColumns.
  const Eigen::VectorXd& GramColumn(int atom);
  // Frees the columns when they have grown beyond a fixed amount of storage.
  void DropOldColumns();

  // |B x - b|^2.
  double ResidualSquared(const SparseCode& code) const;

 private:
  Eigen::MatrixXd rows_;
  Eigen::VectorXd target_, squared_norms_, target_dots_;
  std::unordered_map<int, Eigen::VectorXd> gram_columns_;
};

}  // namespace poselift
