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

// A gain this small against |v|^2 is rounding: v is explained, or nothing that is
// left can explain more of it.
constexpr double kRounding = 1e-24;

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
                      const Eigen::VectorXd& target, const OmpOptions& options, SparseCode* code,
                      ConstantRows* constant) {
  const Eigen::Index num_rows = atoms.rows() + (constant ? constant->num_rows() : 0);
  const auto limit = std::min<Eigen::Index>({options.max_atoms, num_rows, atoms.cols()});
  cholesky_.resize(limit, limit);
  target_dot_.resize(limit);
  gram_row_.resize(limit);
  if (constant) constant->DropOldColumns();
  WeighAtoms(squared_norms, options.ridge, constant);
  residual_ = target;
  residual_squared_ = target.squaredNorm() + (constant ? constant->target_squared() : 0.0);
  const double least_gain = kRounding * residual_squared_;
  code->atoms.clear();
  code->coefficients.resize(0);

  for (Eigen::Index size = 1; size <= limit && residual_squared_ > options.stop_residual_squared;
       ++size) {
    Correlate(atoms, *code, constant);
    int atom = TakeBestAtom(least_gain);
    while (atom >= 0 && !AppendToCholesky(atoms, code->atoms, atom, options.ridge, constant))
      atom = TakeBestAtom(least_gain);
    if (atom < 0) break;
    code->atoms.push_back(atom);
    target_dot_[size - 1] =
        atoms.col(atom).dot(target) + (constant ? constant->target_dots()[atom] : 0.0);
    code->coefficients = target_dot_.head(size);
    const auto factor = cholesky_.topLeftCorner(size, size).triangularView<Eigen::Lower>();
    factor.solveInPlace(code->coefficients);
    factor.transpose().solveInPlace(code->coefficients);
    residual_ = target;
    for (Eigen::Index i = 0; i < size; ++i)
      residual_ -= code->coefficients[i] * atoms.col(code->atoms[i]);
    residual_squared_ =
        residual_.squaredNorm() + (constant ? constant->ResidualSquared(*code) : 0.0);
  }
}

void OmpSolver::WeighAtoms(const Eigen::VectorXd& squared_norms, double ridge,
                           const ConstantRows* constant) {
  atom_weight_ = squared_norms;
  if (constant) atom_weight_ += constant->squared_norms();
  if (atom_weight_.size() == 0) return;
  const double unseen = kUnseen * atom_weight_.maxCoeff();
  for (double& weight : atom_weight_) weight = weight > unseen ? 1.0 / (weight + ridge) : 0.0;
}

void OmpSolver::Correlate(const Eigen::MatrixXd& atoms, const SparseCode& code,
                          ConstantRows* constant) {
  correlation_.noalias() = atoms.transpose() * residual_;
  if (!constant) return;
  correlation_ += constant->target_dots();
  for (size_t i = 0; i < code.atoms.size(); ++i)
    correlation_ -=
        code.coefficients[static_cast<Eigen::Index>(i)] * constant->GramColumn(code.atoms[i]);
}

int OmpSolver::TakeBestAtom(double least_gain) {
  int best = -1;
  double best_gain = least_gain;
  for (Eigen::Index k = 0; k < correlation_.size(); ++k) {
    const double gain = correlation_[k] * correlation_[k] * atom_weight_[k];
    if (gain > best_gain) {
      best_gain = gain;
      best = static_cast<int>(k);
    }
  }
  if (best >= 0) atom_weight_[best] = 0.0;
  return best;
}

bool OmpSolver::AppendToCholesky(const Eigen::MatrixXd& atoms, const std::vector<int>& chosen,
                                 int atom, double ridge, ConstantRows* constant) {
  const auto size = static_cast<Eigen::Index>(chosen.size());
  auto row = gram_row_.head(size);
  for (Eigen::Index i = 0; i < size; ++i) row[i] = atoms.col(atom).dot(atoms.col(chosen[i]));
  double diagonal = atoms.col(atom).squaredNorm() + ridge;
  if (constant) {
    for (Eigen::Index i = 0; i < size; ++i) row[i] += constant->GramColumn(chosen[i])[atom];
    diagonal += constant->squared_norms()[atom];
  }
  cholesky_.topLeftCorner(size, size).triangularView<Eigen::Lower>().solveInPlace(row);
  const double pivot = diagonal - row.squaredNorm();
  if (!(pivot > kDependent * diagonal)) return false;
  cholesky_.row(size).head(size) = row.transpose();
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
