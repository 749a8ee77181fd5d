// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/alternation.h"

#include <Eigen/Cholesky>
#include <utility>

namespace poselift {
namespace {

// Of bounds, in one step of OMP.
constexpr int kMostActiveSets = 4;

}  // namespace

Alternation::Alternation(const Dictionary& dictionary, const LifterOptions& options,
                         const Observation& observation, const Eigen::MatrixXd& prior_rows,
                         const Eigen::VectorXd& prior_target)
    : dictionary_(dictionary),
      options_(options),
      op_(observation),
      centred_atoms_(op_.CentredPointsOfAll(dictionary.atoms)),
      rows_(op_.NumRows(), dictionary.NumAtoms()),
      active_target_(op_.target()),
      prior_(prior_rows, prior_target) {}

void Alternation::Run(int max_alternations, LiftSolution* solution) {
  for (int i = 0; i < max_alternations && !solution->converged; ++i) {
    const double before = solution->objective;
    UpdateCode(solution);
    UpdateRotation(solution);
    UpdateScale(solution);
    const bool first = before < 0.0;
    solution->converged =
        !first && before - solution->objective <= options_.min_improvement * before;
  }
}

void Alternation::UpdateCode(LiftSolution* solution) {
  op_.ApplyToAll(CamFromBody(solution->tau_rad), solution->scale_px_per_m, centred_atoms_, rows_);
  SparseCode code = BestCode(solution->tau_rad);
  double objective = Objective(code, solution->tau_rad);
  if (!solution->code.Empty()) {
    // OMP is greedy: its new choice may be worse than the old atoms refitted.
    SparseCode refitted = solution->code;
    Refit(&refitted);
    const double refitted_objective = Objective(refitted, solution->tau_rad);
    if (!(objective < (1.0 - options_.new_atoms_gain) * refitted_objective)) {
      code = std::move(refitted);
      objective = refitted_objective;
    }
    if (!(objective < solution->objective)) return;
  }
  solution->code = std::move(code);
  solution->pose_in_body_m = Synthesize(dictionary_.atoms, solution->code);
  solution->objective = objective;
  solution->history.push_back(objective);
}

void Alternation::StartFrom(SparseCode code, LiftSolution* solution) {
  op_.ApplyToAll(CamFromBody(solution->tau_rad), solution->scale_px_per_m, centred_atoms_, rows_);
  solution->code = std::move(code);
  solution->pose_in_body_m = Synthesize(dictionary_.atoms, solution->code);
  solution->objective = Objective(solution->code, solution->tau_rad);
  solution->history = {solution->objective};
  solution->converged = false;
}

SparseCode Alternation::BestCode(const Eigen::Vector3d& tau_rad) {
  const auto solve = [&](const Eigen::MatrixXd& rows, const Eigen::VectorXd& target) {
    SparseCode code;
    omp_.Solve(rows, rows.colwise().squaredNorm().transpose(), target, options_.omp, &code,
               &prior_);
    return code;
  };
  if (!op_.HasLowerBounds()) return solve(rows_, op_.target());
  // An active set that only grows: what one answer breaks is a row of the next.
  SparseCode best;
  Eigen::ArrayXd active = op_.ActiveRows(Eigen::VectorXd::Constant(op_.NumRows(), 1.0));
  for (int round = 0; round < kMostActiveSets; ++round) {
    KeepActive(active);
    SparseCode code = solve(active_rows_, active_target_);
    const Eigen::ArrayXd broken =
        op_.ActiveRows(Synthesize(rows_, code) - op_.target()).max(active);
    if (best.Empty() || Objective(code, tau_rad) < Objective(best, tau_rad)) best = std::move(code);
    if ((broken == active).all()) break;
    active = broken;
  }
  return best;
}

void Alternation::KeepActive(const Eigen::ArrayXd& active) {
  active_rows_ = rows_;
  active_rows_.array().colwise() *= active;
  active_target_ = op_.target().array() * active;
}

void Alternation::UpdateRotation(LiftSolution* solution) {
  const RotationEstimate estimate =
      EstimateRotation(op_, op_.CentredPoints(solution->pose_in_body_m), solution->scale_px_per_m,
                       solution->tau_rad, options_.rotation);
  const double objective = estimate.objective + CodeCost(solution->code);
  if (!(objective < solution->objective)) return;
  solution->tau_rad = estimate.tau_rad;
  solution->objective = objective;
  solution->history.push_back(solution->objective);
}

void Alternation::UpdateScale(LiftSolution* solution) {
  const Eigen::Matrix3d R = CamFromBody(solution->tau_rad);
  const Eigen::Matrix3Xd points = op_.CentredPoints(solution->pose_in_body_m);
  const double scale = op_.BestScale_px_per_m(R, points, solution->scale_px_per_m);
  const double objective = op_.Residual(R, scale, points).squaredNorm() +
                           RotationPriorCost(solution->tau_rad, options_.rotation) +
                           CodeCost(solution->code);
  if (!(objective < solution->objective)) return;
  solution->scale_px_per_m = scale;
  solution->objective = objective;
  solution->history.push_back(objective);
}

double Alternation::CodeCost(const SparseCode& code) const {
  return prior_.ResidualSquared(code) + options_.omp.ridge * code.coefficients.squaredNorm();
}

double Alternation::Objective(const SparseCode& code, const Eigen::Vector3d& tau_rad) const {
  Eigen::VectorXd residual = Synthesize(rows_, code) - op_.target();
  op_.LetGoOfBounds(residual);
  return residual.squaredNorm() + CodeCost(code) + RotationPriorCost(tau_rad, options_.rotation);
}

// P1a without the search: the best coefficients on the atoms it has, of the bounds with
// those that it breaks.
void Alternation::Refit(SparseCode* code) {
  Eigen::MatrixXd chosen = rows_(Eigen::all, code->atoms);
  if (op_.HasLowerBounds()) {
    const Eigen::ArrayXd active = op_.ActiveRows(Synthesize(rows_, *code) - op_.target());
    chosen.array().colwise() *= active;
    active_target_ = op_.target().array() * active;
  }
  Eigen::MatrixXd gram = chosen.transpose() * chosen;
  gram.diagonal().array() += options_.omp.ridge;
  for (size_t i = 0; i < code->atoms.size(); ++i)
    gram.col(static_cast<Eigen::Index>(i)) += prior_.GramColumn(code->atoms[i])(code->atoms);
  const Eigen::VectorXd target_dots =
      chosen.transpose() * active_target_ + prior_.target_dots()(code->atoms);
  code->coefficients = gram.ldlt().solve(target_dots);
}

}  // namespace poselift
