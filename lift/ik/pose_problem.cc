// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/ik/pose_problem.h"

#include <ceres/cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

constexpr int kMaxRounds = 8;
constexpr double kOutside_rad = 1e-9;

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

IkStatus StatusOf(ceres::TerminationType termination) {
  if (termination == ceres::CONVERGENCE) return IkStatus::kConverged;
  return termination == ceres::NO_CONVERGENCE ? IkStatus::kMaxIterations : IkStatus::kFailed;
}

}  // namespace

const char* IkStatusName(IkStatus status) {
  switch (status) {
    case IkStatus::kNotRun:
      return "not run";
    case IkStatus::kConverged:
      return "converged";
    case IkStatus::kMaxIterations:
      return "out of iterations";
    case IkStatus::kBadInput:
      return "bad input";
    case IkStatus::kFailed:
      return "failed";
  }
  return "unknown";
}

bool IsUsable(IkStatus status) {
  return status == IkStatus::kConverged || status == IkStatus::kMaxIterations;
}

PoseProblem::PoseProblem(const Articulation& body, const SkeletonPose& start,
                         const DofSprings& springs)
    : pose_(start),
      springs_(springs),
      holds_(body.num_dofs, Hold::kFree),
      problem_(std::make_unique<ceres::Problem>(ProblemOptions())) {
  pose_.dofs = springs.limits.Clamp(pose_.dofs);
  manifolds_.push_back(std::make_unique<ceres::EigenQuaternionManifold>());
  problem_->AddParameterBlock(pose_.root_in_world_m.data(), 3);
  problem_->AddParameterBlock(pose_.world_from_root.coeffs().data(), 4, manifolds_.back().get());
  problem_->AddResidualBlock(MakeSpringCost(springs).release(), nullptr, pose_.dofs.data());
}

PoseProblem::~PoseProblem() = default;

void PoseProblem::AddPoseTerm(std::unique_ptr<ceres::CostFunction> term, double cauchy) {
  ceres::LossFunction* loss = cauchy > 0.0 ? new ceres::CauchyLoss(cauchy) : nullptr;
  problem_->AddResidualBlock(term.release(), loss, pose_.root_in_world_m.data(),
                             pose_.world_from_root.coeffs().data(), pose_.dofs.data());
}

void PoseProblem::AddCameraTerm(std::unique_ptr<ceres::CostFunction> term) {
  problem_->AddResidualBlock(term.release(), nullptr, pose_.root_in_world_m.data(),
                             pose_.world_from_root.coeffs().data(), pose_.dofs.data(),
                             camera_.data());
}

void PoseProblem::AddDofsTerm(std::unique_ptr<ceres::CostFunction> term) {
  problem_->AddResidualBlock(term.release(), nullptr, pose_.dofs.data());
}

void PoseProblem::HoldRootPosition() {
  problem_->SetParameterBlockConstant(pose_.root_in_world_m.data());
}

PoseProblemOutcome PoseProblem::Solve(int max_iterations, double function_tolerance) {
  PoseProblemOutcome outcome;
  SkeletonPose best_pose = pose_;
  Eigen::Vector3d best_camera = camera_;
  double best_cost = Cost();
  int iterations = 0;
  bool settled = false;
  for (int round = 0; round < kMaxRounds && !settled; ++round) {
    outcome = Minimize(max_iterations - iterations, function_tolerance);
    iterations += outcome.iterations;
    if (outcome.status == IkStatus::kFailed) break;
    const bool all_inside = !HoldOutsideDofs();
    if (const double cost = Cost(); cost <= best_cost) {
      best_pose = pose_;
      best_camera = camera_;
      best_cost = cost;
    }
    settled = all_inside && !ReleaseInsideDofs();
    if (!settled) ApplyHeld();
    if (outcome.status == IkStatus::kMaxIterations || iterations >= max_iterations) break;
  }
  outcome.iterations = iterations;
  if (outcome.status == IkStatus::kConverged && !settled) {
    outcome.status = IkStatus::kMaxIterations;
    outcome.message = "the set of active limits did not settle";
  }
  pose_ = best_pose;
  camera_ = best_camera;
  return outcome;
}

Eigen::MatrixXd PoseProblem::Covariance() {
  const Eigen::Index size = 6 + pose_.dofs.size();
  problem_->SetParameterBlockVariable(pose_.dofs.data());
  problem_->SetManifold(pose_.dofs.data(), nullptr);
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {pose_.root_in_world_m.data(), pose_.world_from_root.coeffs().data(),
                              pose_.dofs.data()};
  ceres::CRSMatrix sparse;
  if (!problem_->Evaluate(options, nullptr, nullptr, nullptr, &sparse)) return {};
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, size);
  for (int row = 0; row < sparse.num_rows; ++row)
    for (int i = sparse.rows[row]; i < sparse.rows[row + 1]; ++i)
      jacobian(row, sparse.cols[i]) = sparse.values[i];
  // A step d of EigenQuaternionManifold turns by 2 d.
  jacobian.middleCols<3>(3) *= 0.5;
  const Eigen::LLT<Eigen::MatrixXd> information(jacobian.transpose() * jacobian);
  if (information.info() != Eigen::Success) return {};
  return information.solve(Eigen::MatrixXd::Identity(size, size));
}

double PoseProblem::Cost() {
  double cost = 0.0;
  problem_->Evaluate(ceres::Problem::EvaluateOptions(), &cost, nullptr, nullptr, nullptr);
  return cost;
}

PoseProblemOutcome PoseProblem::Minimize(int max_iterations, double function_tolerance) {
  ceres::Solver::Options options;
  // Twice as fast as DENSE_QR here; the springs keep it well posed.
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  // The start is good: nearly full Gauss-Newton steps from the first.
  options.initial_trust_region_radius = 1e6;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = function_tolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem_.get(), &summary);
  // Iteration 0 is the evaluation of the start.
  const int iterations = static_cast<int>(summary.iterations.size()) - 1;
  return {StatusOf(summary.termination_type), summary.message, std::max(0, iterations)};
}

// Brings free dofs from outside to their limit. False when there was none.
bool PoseProblem::HoldOutsideDofs() {
  bool any = false;
  const Eigen::VectorXd inside = springs_.limits.Clamp(pose_.dofs);
  for (size_t d = 0; d < holds_.size(); ++d) {
    if (std::abs(pose_.dofs[d] - inside[d]) <= kOutside_rad) continue;
    holds_[d] = holds_[d] == Hold::kReleased ? Hold::kKept : Hold::kHeld;
    any = true;
  }
  pose_.dofs = inside;
  return any;
}

// Lets held dofs go whose cost falls towards the inside. False when there was none.
bool PoseProblem::ReleaseInsideDofs() {
  if (std::find(holds_.begin(), holds_.end(), Hold::kHeld) == holds_.end()) return false;
  problem_->SetParameterBlockVariable(pose_.dofs.data());
  problem_->SetManifold(pose_.dofs.data(), nullptr);
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {pose_.dofs.data()};
  std::vector<double> gradient;
  problem_->Evaluate(options, nullptr, nullptr, &gradient, nullptr);
  bool any = false;
  for (size_t d = 0; d < holds_.size(); ++d) {
    if (holds_[d] != Hold::kHeld) continue;
    const bool at_lower = pose_.dofs[d] <= springs_.limits.lower[d];
    if (at_lower ? gradient[d] >= 0.0 : gradient[d] <= 0.0) continue;
    holds_[d] = Hold::kReleased;
    any = true;
  }
  return any;
}

void PoseProblem::ApplyHeld() {
  std::vector<int> held;
  for (size_t d = 0; d < holds_.size(); ++d)
    if (holds_[d] == Hold::kHeld || holds_[d] == Hold::kKept) held.push_back(static_cast<int>(d));
  double* dofs = pose_.dofs.data();
  problem_->SetParameterBlockVariable(dofs);
  problem_->SetManifold(dofs, nullptr);
  if (held.size() == holds_.size()) {
    problem_->SetParameterBlockConstant(dofs);
  } else if (!held.empty()) {
    const int num_dofs = static_cast<int>(holds_.size());
    manifolds_.push_back(std::make_unique<ceres::SubsetManifold>(num_dofs, held));
    problem_->SetManifold(dofs, manifolds_.back().get());
  }
}

}  // namespace poselift
