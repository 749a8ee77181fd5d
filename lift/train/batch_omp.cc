// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/train/batch_omp.h"

#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

constexpr double kDependent = 1e-10;  // a chosen atom must add this much to the span
constexpr Eigen::Index kBlock = 512;  // poses a block: A^T Y by one matrix product

// One pose: correlations alpha_0 = A^T y in, code out. Scratch is kept between
// poses.
class PoseCoder {
 public:
  PoseCoder(const Eigen::MatrixXd& gram, int sparsity)
      : gram_(gram), cholesky_(sparsity, sparsity), chosen_(sparsity), target_(sparsity) {}

  int Code(const Eigen::Ref<const Eigen::VectorXd>& start_correlation, Eigen::MatrixXi* atoms,
           Eigen::MatrixXd* coefficients, Eigen::Index column) {
    const auto sparsity = static_cast<int>(chosen_.size());
    correlation_ = start_correlation;
    int size = 0;
    while (size < sparsity) {
      Eigen::Index best = 0;
      if (correlation_.cwiseAbs().maxCoeff(&best) <= 1e-12 * start_correlation.norm()) break;
      if (!Append(static_cast<int>(best), size)) break;
      target_[size++] = start_correlation[best];
      solution_ = target_.head(size);
      const auto factor = cholesky_.topLeftCorner(size, size).triangularView<Eigen::Lower>();
      factor.solveInPlace(solution_);
      factor.transpose().solveInPlace(solution_);
      correlation_ = start_correlation;
      for (int i = 0; i < size; ++i) correlation_ -= solution_[i] * gram_.col(chosen_[i]);
    }
    for (int i = 0; i < size; ++i) {
      (*atoms)(i, column) = chosen_[i];
      (*coefficients)(i, column) = solution_[i];
    }
    return size;
  }

 private:
  bool Append(int atom, int size) {
    row_.resize(size);
    for (int i = 0; i < size; ++i) row_[i] = gram_(chosen_[i], atom);
    cholesky_.topLeftCorner(size, size).triangularView<Eigen::Lower>().solveInPlace(row_);
    const double pivot = gram_(atom, atom) - row_.squaredNorm();
    if (!(pivot > kDependent)) return false;
    cholesky_.row(size).head(size) = row_.transpose();
    cholesky_(size, size) = std::sqrt(pivot);
    chosen_[size] = atom;
    return true;
  }

  const Eigen::MatrixXd& gram_;
  Eigen::MatrixXd cholesky_;
  Eigen::VectorXi chosen_;
  Eigen::VectorXd target_, correlation_, solution_, row_;
};

}  // namespace

SparseCodes BatchOmp(const Eigen::MatrixXd& atoms, const Eigen::MatrixXd& poses, int sparsity) {
  const int limit =
      static_cast<int>(std::min<Eigen::Index>({sparsity, atoms.rows(), atoms.cols()}));
  SparseCodes codes{Eigen::MatrixXi::Zero(limit, poses.cols()),
                    Eigen::MatrixXd::Zero(limit, poses.cols()),
                    Eigen::VectorXi::Zero(poses.cols())};
  const Eigen::MatrixXd gram = atoms.transpose() * atoms;
  PoseCoder coder(gram, limit);
  Eigen::MatrixXd correlations;
  for (Eigen::Index first = 0; first < poses.cols(); first += kBlock) {
    const Eigen::Index count = std::min(kBlock, poses.cols() - first);
    correlations.noalias() = atoms.transpose() * poses.middleCols(first, count);
    for (Eigen::Index j = 0; j < count; ++j)
      codes.sizes[first + j] =
          coder.Code(correlations.col(j), &codes.atoms, &codes.coefficients, first + j);
  }
  return codes;
}

Eigen::VectorXd CodingErrors(const Eigen::MatrixXd& atoms, const Eigen::MatrixXd& poses,
                             const SparseCodes& codes) {
  Eigen::VectorXd errors(poses.cols());
  Eigen::VectorXd residual(poses.rows());
  for (Eigen::Index j = 0; j < poses.cols(); ++j) {
    residual = poses.col(j);
    for (int i = 0; i < codes.sizes[j]; ++i)
      residual -= codes.coefficients(i, j) * atoms.col(codes.atoms(i, j));
    errors[j] = residual.squaredNorm();
  }
  return errors;
}

}  // namespace poselift
