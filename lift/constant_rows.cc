// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/constant_rows.h"

#include <utility>

namespace poselift {
namespace {

constexpr size_t kMostNumbers = size_t{8} << 20;  // 64 MB of Gram columns

}  // namespace

ConstantRows::ConstantRows(Eigen::MatrixXd rows, Eigen::VectorXd target)
    : rows_(std::move(rows)),
      target_(std::move(target)),
      squared_norms_(rows_.colwise().squaredNorm().transpose()),
      target_dots_(rows_.transpose() * target_) {}

const Eigen::VectorXd& ConstantRows::GramColumn(int atom) {
  Eigen::VectorXd& column = gram_columns_[atom];
  if (column.size() == 0) column.noalias() = rows_.transpose() * rows_.col(atom);
  return column;
}

void ConstantRows::DropOldColumns() {
  if (gram_columns_.size() * static_cast<size_t>(rows_.cols()) > kMostNumbers)
    gram_columns_.clear();
}

double ConstantRows::ResidualSquared(const SparseCode& code) const {
  return (Synthesize(rows_, code) - target_).squaredNorm();
}

}  // namespace poselift
