// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/ik/pose_problem.h"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

DofSprings MakeDofSprings(const Articulation& body, const Eigen::VectorXd& rest_dofs, double pull,
                          double stiffness, bool enforce_limits) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  DofSprings springs{.pull = pull, .stiffness = stiffness};
  springs.lower.setConstant(body.num_dofs, -kInfinity);
  springs.upper.setConstant(body.num_dofs, kInfinity);
  if (enforce_limits) {
    Eigen::Index d = 0;
    for (const Bone& bone : body.skeleton.bones)
      for (const Dof& dof : bone.dofs) {
        springs.lower[d] = dof.lower;
        springs.upper[d++] = dof.upper;
      }
  }
  springs.rest = rest_dofs.cwiseMax(springs.lower).cwiseMin(springs.upper);
  return springs;
}

PoseProblem::PoseProblem(const Articulation& body, const SkeletonPose& start,
                         const DofSprings& springs)
    : pose_(start),
      springs_(springs),
      holds_(body.num_dofs, Hold::kFree),
      problem_(std::make_unique<ceres::Problem>(ProblemOptions())) {
  pose_.dofs = pose_.dofs.cwiseMax(springs.lower).cwiseMin(springs.upper);
  manifolds_.push_back(std::make_unique<ceres::EigenQuaternionManifold>());
  problem_->AddParameterBlock(pose_.root_in_world_m.data(), 3);
  problem_->AddParameterBlock(pose_.world_from_root.coeffs().data(), 4, manifolds_.back().get());
  problem_->AddResidualBlock(MakeSpringCost(springs).release(), nullptr, pose_.dofs.data());
}

PoseProblem::~PoseProblem() = default;

void PoseProblem::AddPoseTerm(std::unique_ptr<ceres::CostFunction> term) {
  problem_->AddResidualBlock(term.release(), nullptr, pose_.root_in_world_m.data(),
                             pose_.world_from_root.coeffs().data(), pose_.dofs.data());
}

void PoseProblem::AddCameraTerm(std::unique_ptr<ceres::CostFunction> term) {
  problem_->AddResidualBlock(term.release(), nullptr, pose_.root_in_world_m.data(),
                             pose_.world_from_root.coeffs().data(), pose_.dofs.data(),
                             camera_.data());
}

void PoseProblem::HoldRootPosition() {
  problem_->SetParameterBlockConstant(pose_.root_in_world_m.data());
}

PoseProblemOutcome PoseProblem::Solve(int max_iterations, double function_tolerance) {
  PoseProblemOutcome outcome;
  int iterations = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    outcome = Minimize(max_iterations - iterations, function_tolerance);
    iterations += outcome.iterations;
    if (outcome.status != IkStatus::kConverged) break;
    if (!HoldOutsideDofs() && !ReleaseInsideDofs()) break;
    ApplyHeld();
    outcome.status = IkStatus::kMaxIterations;
    outcome.message = "the set of active limits did not settle";
    if (iterations >= max_iterations) break;
  }
  outcome.iterations = iterations;
  pose_.dofs = pose_.dofs.cwiseMax(springs_.lower).cwiseMin(springs_.upper);
  return outcome;
}

PoseProblemOutcome PoseProblem::Minimize(int max_iterations, double function_tolerance) {
  ceres::Solver::Options options;
  // Three times as fast as DENSE_QR here; the springs keep it well posed.
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
  for (size_t d = 0; d < holds_.size(); ++d) {
    const double inside = std::clamp(pose_.dofs[d], springs_.lower[d], springs_.upper[d]);
    if (std::abs(pose_.dofs[d] - inside) > kOutside_rad) {
      holds_[d] = holds_[d] == Hold::kReleased ? Hold::kKept : Hold::kHeld;
      any = true;
    }
    pose_.dofs[d] = inside;
  }
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
    const bool at_lower = pose_.dofs[d] <= springs_.lower[d];
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
