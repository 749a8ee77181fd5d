// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/omp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

// A column this small against the largest is not seen by the operator: what is
// left of it is rounding.
constexpr double kUnseen = 1e-12;

// A chosen atom must add at least this share of its energy to the span.
constexpr double kDependent = 1e-10;

}  // namespace

std::string OmpOptions::Validate() const {
  if (max_atoms < 1) return fmt::format("OmpOptions::max_atoms = {}, wanted at least 1", max_atoms);
  if (!(ridge >= 0.0)) return fmt::format("OmpOptions::ridge = {}, wanted at least 0", ridge);
  if (!(stop_residual_squared >= 0.0))
    return fmt::format("OmpOptions::stop_residual_squared = {}, wanted at least 0",
                       stop_residual_squared);
  return "";
}

void OmpSolver::Solve(const Eigen::MatrixXd& atoms, const Eigen::VectorXd& squared_norms,
                      const Eigen::VectorXd& target, const OmpOptions& options, SparseCode* code) {
  const int limit =
      static_cast<int>(std::min<Eigen::Index>({options.max_atoms, atoms.rows(), atoms.cols()}));
  taken_.assign(static_cast<size_t>(atoms.cols()), 0);
  cholesky_.resize(limit, limit);
  target_dot_.resize(limit);
  residual_ = target;
  residual_squared_ = target.squaredNorm();
  std::vector<int>& chosen = code->atoms;
  chosen.clear();
  code->coefficients.resize(0);

  for (int size = 0; size < limit && residual_squared_ > options.stop_residual_squared;) {
    correlation_.noalias() = atoms.transpose() * residual_;
    const int atom = BestAtom(squared_norms, options.ridge);
    if (atom < 0) break;
    taken_[atom] = 1;
    if (!AppendToCholesky(atoms, chosen, atom, options.ridge)) continue;
    chosen.push_back(atom);
    target_dot_[size++] = atoms.col(atom).dot(target);
    const auto factor = cholesky_.topLeftCorner(size, size).triangularView<Eigen::Lower>();
    solution_ = target_dot_.head(size);
    factor.solveInPlace(solution_);
    factor.transpose().solveInPlace(solution_);
    residual_ = target;
    for (int i = 0; i < size; ++i) residual_ -= solution_[i] * atoms.col(chosen[i]);
    residual_squared_ = residual_.squaredNorm();
  }
  if (!code->Empty()) code->coefficients = solution_;
}

int OmpSolver::BestAtom(const Eigen::VectorXd& squared_norms, double ridge) const {
  const double smallest = kUnseen * squared_norms.maxCoeff();
  int best = -1;
  double best_gain = 0.0;
  for (Eigen::Index k = 0; k < squared_norms.size(); ++k) {
    if (taken_[k] || squared_norms[k] <= smallest) continue;
    const double gain = correlation_[k] * correlation_[k] / (squared_norms[k] + ridge);
    if (gain > best_gain) {
      best_gain = gain;
      best = static_cast<int>(k);
    }
  }
  return best;
}

bool OmpSolver::AppendToCholesky(const Eigen::MatrixXd& atoms, const std::vector<int>& chosen,
                                 int atom, double ridge) {
  const auto size = static_cast<Eigen::Index>(chosen.size());
  const double diagonal = atoms.col(atom).squaredNorm() + ridge;
  gram_row_.resize(size);
  for (Eigen::Index i = 0; i < size; ++i) gram_row_[i] = atoms.col(atom).dot(atoms.col(chosen[i]));
  cholesky_.topLeftCorner(size, size).triangularView<Eigen::Lower>().solveInPlace(gram_row_);
  const double pivot = diagonal - gram_row_.squaredNorm();
  if (!(pivot > kDependent * diagonal)) return false;
  cholesky_.row(size).head(size) = gram_row_.transpose();
  cholesky_(size, size) = std::sqrt(pivot);
  return true;
}

SparseCode OrthogonalMatchingPursuit(const Eigen::MatrixXd& atoms, const Eigen::VectorXd& target,
                                     const OmpOptions& options) {
  OmpSolver solver;
  SparseCode code;
  solver.Solve(atoms, atoms.colwise().squaredNorm().transpose(), target, options, &code);
  return code;
}

}  // namespace poselift
