// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/marginal_covariances.h"

#include <ceres/crs_matrix.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace poselift {
namespace {

// Unknowns that nothing is said of have a covariance too, a large one.
constexpr double kLeastInformation = 1e-9;

// A symmetric matrix whose blocks couple with the next alone.
struct BlockTridiagonal {
  std::vector<Eigen::MatrixXd> diagonal;
  std::vector<Eigen::MatrixXd> below;  // rows of block k + 1, columns of block k
};

struct Entry {
  size_t block;
  Eigen::Index place;  // in the block
  double value;
};

// J^T J, row by row of J.
BlockTridiagonal NormalMatrix(const ceres::CRSMatrix& jacobian,
                              const std::vector<int>& block_sizes) {
  BlockTridiagonal normal;
  std::vector<Entry> at;  // of each column
  for (size_t k = 0; k < block_sizes.size(); ++k) {
    normal.diagonal.emplace_back(kLeastInformation *
                                 Eigen::MatrixXd::Identity(block_sizes[k], block_sizes[k]));
    if (k > 0) normal.below.emplace_back(Eigen::MatrixXd::Zero(block_sizes[k], block_sizes[k - 1]));
    for (int i = 0; i < block_sizes[k]; ++i) at.push_back({k, i, 0.0});
  }
  std::vector<Entry> row;
  for (int r = 0; r < jacobian.num_rows; ++r) {
    row.clear();
    for (int i = jacobian.rows[r]; i < jacobian.rows[r + 1]; ++i) {
      if (jacobian.values[i] == 0.0) continue;
      row.push_back(at[jacobian.cols[i]]);
      row.back().value = jacobian.values[i];
    }
    for (const Entry& a : row)
      for (const Entry& b : row) {
        if (a.block == b.block)
          normal.diagonal[a.block](a.place, b.place) += a.value * b.value;
        else if (a.block == b.block + 1)
          normal.below[b.block](a.place, b.place) += a.value * b.value;
        else if (a.block > b.block)
          throw std::invalid_argument("MarginalCovariances: a residual of too many frames");
      }
  }
  return normal;
}

// The diagonal blocks of the inverse; empty when there is none.
std::vector<Eigen::MatrixXd> InverseBlocks(BlockTridiagonal matrix) {
  std::vector<Eigen::MatrixXd>& inverse = matrix.diagonal;  // in its place
  for (size_t k = 0; k < inverse.size(); ++k) {
    if (k > 0) {
      const Eigen::MatrixXd& coupling = matrix.below[k - 1];
      const Eigen::MatrixXd K = coupling * inverse[k - 1];
      inverse[k].noalias() -= K * coupling.transpose();
      matrix.below[k - 1] = K;
    }
    const Eigen::LLT<Eigen::MatrixXd> cholesky(inverse[k]);
    if (cholesky.info() != Eigen::Success) return {};
    inverse[k].setIdentity();
    cholesky.solveInPlace(inverse[k]);
  }
  for (size_t k = matrix.below.size(); k-- > 0;)
    inverse[k] += matrix.below[k].transpose() * inverse[k + 1] * matrix.below[k];
  return std::move(inverse);
}

}  // namespace

std::vector<Eigen::MatrixXd> MarginalCovariances(const ceres::CRSMatrix& jacobian,
                                                 const std::vector<int>& frame_sizes) {
  if (std::accumulate(frame_sizes.begin(), frame_sizes.end(), 0) != jacobian.num_cols)
    throw std::invalid_argument("MarginalCovariances: the sizes are not those of the Jacobian");
  std::vector<int> pair_sizes((frame_sizes.size() + 1) / 2, 0);
  for (size_t t = 0; t < frame_sizes.size(); ++t) pair_sizes[t / 2] += frame_sizes[t];
  const std::vector<Eigen::MatrixXd> pairs = InverseBlocks(NormalMatrix(jacobian, pair_sizes));
  if (pairs.size() < pair_sizes.size()) return {};
  std::vector<Eigen::MatrixXd> frames;
  for (size_t t = 0; t < frame_sizes.size(); ++t) {
    const int size = frame_sizes[t];
    const Eigen::MatrixXd& pair = pairs[t / 2];
    frames.emplace_back(t % 2 == 0 ? pair.topLeftCorner(size, size)
                                   : pair.bottomRightCorner(size, size));
  }
  return frames;
}

Eigen::MatrixXd CovarianceOfLast(const ceres::CRSMatrix& jacobian, int size) {
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> J(
      jacobian.num_rows, jacobian.num_cols, static_cast<Eigen::Index>(jacobian.values.size()),
      jacobian.rows.data(), jacobian.cols.data(), jacobian.values.data());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
  factors.setShift(kLeastInformation);
  factors.compute(J.transpose() * J);
  if (factors.info() != Eigen::Success) return {};
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(jacobian.num_cols, size);
  units.bottomRows(size).setIdentity();
  return factors.solve(units).bottomRows(size);
}

}  // namespace poselift
