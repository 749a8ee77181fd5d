// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/train/ksvd.h"

#include <fmt/format.h>

#include <cmath>

#include "lift/train/batch_omp.h"
#include "src/joints.h"

namespace poselift {
namespace {

constexpr int kPowerIterations = 4;

// Where each atom is used: (row in the codes, pose).
using Uses = std::vector<std::vector<std::pair<int, Eigen::Index>>>;

Uses FindUses(const SparseCodes& codes, Eigen::Index num_atoms) {
  Uses uses(static_cast<size_t>(num_atoms));
  for (Eigen::Index j = 0; j < codes.sizes.size(); ++j)
    for (int i = 0; i < codes.sizes[j]; ++i) uses[codes.atoms(i, j)].emplace_back(i, j);
  return uses;
}

// R = Y - A X.
Eigen::MatrixXd Residual(const Eigen::MatrixXd& poses, const Eigen::MatrixXd& atoms,
                         const SparseCodes& codes) {
  Eigen::MatrixXd residual = poses;
  for (Eigen::Index j = 0; j < poses.cols(); ++j)
    for (int i = 0; i < codes.sizes[j]; ++i)
      residual.col(j) -= codes.coefficients(i, j) * atoms.col(codes.atoms(i, j));
  return residual;
}

// The first singular pair of E, starting from the atom as it is.
void FirstSingularPair(const Eigen::MatrixXd& E, Eigen::VectorXd* left, Eigen::VectorXd* right) {
  for (int i = 0; i < kPowerIterations; ++i) {
    right->noalias() = E.transpose() * *left;
    Eigen::VectorXd next = E * *right;
    const double norm = next.norm();
    if (!(norm > 0.0)) return;
    *left = next / norm;
  }
  right->noalias() = E.transpose() * *left;
}

void UpdateAtoms(const Uses& uses, SparseCodes* codes, Eigen::MatrixXd* residual,
                 Eigen::MatrixXd* atoms) {
  Eigen::MatrixXd E;
  Eigen::VectorXd atom, coefficients;
  for (Eigen::Index k = 0; k < atoms->cols(); ++k) {
    const auto& used = uses[k];
    if (used.empty()) continue;
    const auto count = static_cast<Eigen::Index>(used.size());
    E.resize(residual->rows(), count);
    for (Eigen::Index c = 0; c < count; ++c) {
      const auto [row, pose] = used[c];
      E.col(c) = residual->col(pose) + codes->coefficients(row, pose) * atoms->col(k);
    }
    atom = atoms->col(k);
    FirstSingularPair(E, &atom, &coefficients);
    if (coefficients.sum() < 0.0) {  // an atom looks like a pose, not its negative
      atom = -atom;
      coefficients = -coefficients;
    }
    atoms->col(k) = atom;
    for (Eigen::Index c = 0; c < count; ++c) {
      const auto [row, pose] = used[c];
      codes->coefficients(row, pose) = coefficients[c];
      residual->col(pose) = E.col(c) - coefficients[c] * atom;
    }
  }
}

// The worst coded poses get an atom each; no code uses it yet.
void ReplaceUnused(const Uses& uses, const Eigen::MatrixXd& residual, Eigen::MatrixXd* atoms) {
  Eigen::RowVectorXd errors = residual.colwise().squaredNorm();
  for (Eigen::Index k = 0; k < atoms->cols(); ++k) {
    if (!uses[k].empty()) continue;
    Eigen::Index worst = 0;
    if (!(errors.maxCoeff(&worst) > 0.0)) return;
    atoms->col(k) = residual.col(worst).normalized();
    errors[worst] = 0.0;
  }
}

}  // namespace

std::string KsvdOptions::Validate() const {
  if (sparsity < 1) return fmt::format("KsvdOptions::sparsity = {}, wanted at least 1", sparsity);
  if (max_iterations < 1)
    return fmt::format("KsvdOptions::max_iterations = {}, wanted at least 1", max_iterations);
  if (!(min_improvement >= 0.0))
    return fmt::format("KsvdOptions::min_improvement = {}, wanted at least 0", min_improvement);
  return "";
}

double JointRms_m(double squared_error_m2, Eigen::Index num_poses) {
  return std::sqrt(squared_error_m2 / (static_cast<double>(num_poses) * kNumJoints));
}

KsvdReport TrainKsvd(const Eigen::MatrixXd& poses, const KsvdOptions& options,
                     Eigen::MatrixXd* atoms) {
  KsvdReport report;
  std::vector<double>& errors = report.rms_error_m;
  atoms->colwise().normalize();
  Eigen::MatrixXd before;
  for (int iteration = 0;; ++iteration) {
    SparseCodes codes = BatchOmp(*atoms, poses, options.sparsity);
    Eigen::MatrixXd residual = Residual(poses, *atoms, codes);
    const double error = JointRms_m(residual.squaredNorm(), poses.cols());
    if (!errors.empty() && !(error < errors.back())) {
      *atoms = before;
      return report;
    }
    const bool settled = !errors.empty() && errors.back() - error < options.min_improvement * error;
    const Uses uses = FindUses(codes, atoms->cols());
    errors.push_back(error);
    report.atom_use.clear();
    for (const auto& used : uses) report.atom_use.push_back(static_cast<int>(used.size()));
    if (settled || iteration == options.max_iterations) return report;
    before = *atoms;
    UpdateAtoms(uses, &codes, &residual, atoms);
    ReplaceUnused(uses, residual, atoms);
  }
}

}  // namespace poselift
