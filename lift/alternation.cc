// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/alternation.h"

#include <Eigen/Cholesky>
#include <utility>

namespace poselift {

Alternation::Alternation(const Dictionary& dictionary, const LifterOptions& options,
                         const Observation& observation, const Eigen::MatrixXd& prior_rows,
                         const Eigen::VectorXd& prior_target)
    : dictionary_(dictionary),
      options_(options),
      op_(observation),
      centred_atoms_(op_.CentredPointsOfAll(dictionary.atoms)),
      rows_(op_.NumRows(), dictionary.NumAtoms()),
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
  SparseCode code;
  omp_.Solve(rows_, rows_.colwise().squaredNorm().transpose(), op_.target(), options_.omp, &code,
             &prior_);
  double objective = Objective(code, solution->tau_rad);
  if (!solution->code.Empty()) {
    // OMP is greedy: its new choice may be worse than the old atoms refitted.
    SparseCode refitted = solution->code;
    Refit(&refitted);
    const double refitted_objective = Objective(refitted, solution->tau_rad);
    if (!(objective < refitted_objective)) {
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
  const double objective = (op_.Rows(R, scale, points) - op_.target()).squaredNorm() +
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
  return (Synthesize(rows_, code) - op_.target()).squaredNorm() + CodeCost(code) +
         RotationPriorCost(tau_rad, options_.rotation);
}

// P1a without the search: the best coefficients on the atoms it has.
void Alternation::Refit(SparseCode* code) {
  const Eigen::MatrixXd chosen = rows_(Eigen::all, code->atoms);
  Eigen::MatrixXd gram = chosen.transpose() * chosen;
  gram.diagonal().array() += options_.omp.ridge;
  for (size_t i = 0; i < code->atoms.size(); ++i)
    gram.col(static_cast<Eigen::Index>(i)) += prior_.GramColumn(code->atoms[i])(code->atoms);
  const Eigen::VectorXd target_dots =
      chosen.transpose() * op_.target() + prior_.target_dots()(code->atoms);
  code->coefficients = gram.ldlt().solve(target_dots);
}

}  // namespace poselift
