// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Many made-up problems, with and without prior, ridge, masks and mixtures: the
// objective never rises, and it is what Eq. (7) says of the solution.
#include "lift/alternation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/planted_pose.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::RandomMatrix;
using testing::TestRng;

// A problem that no solution explains.
struct Problem {
  Dictionary dictionary;
  LifterOptions options;
  Observation observation;
  Eigen::MatrixXd prior_rows;
  Eigen::VectorXd prior_target;
};

Problem RandomProblem(int trial, std::mt19937_64* rng) {
  Problem problem{testing::RandomDictionary(20 + trial, rng), {}, {}, {}, {}};
  problem.options.omp.max_atoms = 1 + trial % 9;
  problem.options.omp.ridge = trial % 3 == 0 ? 0.0 : 0.05 * trial;
  problem.options.min_improvement = 0.0;
  const auto planted = testing::PlantPose(problem.dictionary, 5, rng);
  const double noise = trial % 5 == 0 ? 0.0 : 1.0;
  if (trial % 4 == 0) {
    problem.observation = testing::RandomMixture(rng);
  } else if (trial % 4 == 1) {
    problem.observation = testing::Masked(testing::ObserveInSpace(planted, 0.02), 0.5, rng);
    for (ObservedPoint& point : problem.observation.points)
      point.x += 0.1 * noise * RandomMatrix(3, 1, rng);
  } else {
    problem.observation = testing::Masked(testing::ObserveInPicture(planted, 3.0), 0.5, rng);
    for (ObservedPoint& point : problem.observation.points)
      point.x.head<2>() += 20.0 * noise * RandomMatrix(2, 1, rng);
  }
  const int prior_rows = trial % 2 == 0 ? 0 : 30;
  problem.prior_rows = RandomMatrix(prior_rows, 3 * kNumJoints, rng) * problem.dictionary.atoms;
  problem.prior_target = RandomMatrix(prior_rows, 1, rng);
  return problem;
}

LiftSolution Solve(const Problem& problem, const Eigen::Vector3d& start, int max_alternations) {
  Alternation alternation(problem.dictionary, problem.options, problem.observation,
                          problem.prior_rows, problem.prior_target);
  LiftSolution solution;
  solution.tau_rad = start;
  solution.scale_px_per_m = 80.0;
  alternation.Run(max_alternations, &solution);
  return solution;
}

TEST(Alternation, ObjectiveNeverRisesWithHintsEither) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 60; ++trial) {
    Problem problem = RandomProblem(trial, &rng);
    problem.observation.relations = testing::SomeRelations();
    const LiftSolution solution = Solve(problem, 2.0 * RandomMatrix(3, 1, &rng), 30);
    ASSERT_FALSE(solution.history.empty());
    EXPECT_TRUE(std::is_sorted(solution.history.rbegin(), solution.history.rend()));
    // The objective is that of the bounds as they stand, not of those that were active.
    const ProjectionOperator op(problem.observation);
    const Eigen::Matrix3d R = CamFromBody(solution.tau_rad);
    const double rows =
        op.Residual(R, solution.scale_px_per_m, op.CentredPoints(solution.pose_in_body_m))
            .squaredNorm();
    const double prior =
        (problem.prior_rows(Eigen::all, solution.code.atoms) * solution.code.coefficients -
         problem.prior_target)
            .squaredNorm();
    const double expected = rows + prior +
                            problem.options.omp.ridge * solution.code.coefficients.squaredNorm() +
                            RotationPriorCost(solution.tau_rad, problem.options.rotation);
    EXPECT_NEAR(solution.objective, expected, 1e-9 * op.target().squaredNorm());
  }
}

TEST(Alternation, ObjectiveNeverRises) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 150; ++trial) {
    const Problem problem = RandomProblem(trial, &rng);
    const LiftSolution solution = Solve(problem, 2.0 * RandomMatrix(3, 1, &rng), 40);
    ASSERT_FALSE(solution.history.empty());
    EXPECT_TRUE(std::is_sorted(solution.history.rbegin(), solution.history.rend()))
        << "trial " << trial;
    EXPECT_EQ(solution.history.back(), solution.objective);
  }
}

// Greedy choices alone would rise: the refit of the old support is needed.
TEST(Alternation, GreedyChoiceIsOftenWorseThanTheOldSupport) {
  std::mt19937_64 rng = TestRng();
  int rises = 0;
  for (int trial = 1; trial < 60; trial += 2) {
    const Problem problem = RandomProblem(trial, &rng);
    const LiftSolution solution = Solve(problem, 2.0 * RandomMatrix(3, 1, &rng), 40);
    const ProjectionOperator op(problem.observation);
    Eigen::MatrixXd rows(op.NumRows() + problem.prior_rows.rows(), problem.dictionary.NumAtoms());
    op.ApplyToAll(CamFromBody(solution.tau_rad), solution.scale_px_per_m,
                  op.CentredPointsOfAll(problem.dictionary.atoms), rows.topRows(op.NumRows()));
    rows.bottomRows(problem.prior_rows.rows()) = problem.prior_rows;
    Eigen::VectorXd target(rows.rows());
    target << op.target(), problem.prior_target;
    const auto cost = [&](const SparseCode& code) {
      return (Synthesize(rows, code) - target).squaredNorm() +
             problem.options.omp.ridge * code.coefficients.squaredNorm();
    };
    const SparseCode greedy = OrthogonalMatchingPursuit(rows, target, problem.options.omp);
    if (cost(greedy) > cost(solution.code) * (1 + 1e-9)) ++rises;
  }
  EXPECT_GT(rises, 0);
}

TEST(Alternation, ObjectiveIsEq7OfTheSolution) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 1; trial < 40; ++trial) {
    const Problem problem = RandomProblem(trial, &rng);
    const LiftSolution solution = Solve(problem, 2.0 * RandomMatrix(3, 1, &rng), 6);
    const ProjectionOperator op(problem.observation);
    const Eigen::VectorXd pose = Synthesize(problem.dictionary.atoms, solution.code);
    const double expected =
        (op.Apply(CamFromBody(solution.tau_rad), solution.scale_px_per_m, pose) - op.target())
            .squaredNorm() +
        RotationPriorCost(solution.tau_rad, problem.options.rotation) +
        (Synthesize(problem.prior_rows, solution.code) - problem.prior_target).squaredNorm() +
        problem.options.omp.ridge * solution.code.coefficients.squaredNorm();
    EXPECT_NEAR(solution.objective, expected, 1e-9 * op.target().squaredNorm());
    EXPECT_TRUE(testing::MatrixNear(solution.pose_in_body_m, pose, 1e-12));
    EXPECT_LE(solution.code.atoms.size(), static_cast<size_t>(problem.options.omp.max_atoms));
  }
}

TEST(Alternation, RunningOnEqualsOneLongRun) {
  std::mt19937_64 rng = TestRng();
  const Problem problem = RandomProblem(7, &rng);
  Alternation alternation(problem.dictionary, problem.options, problem.observation,
                          problem.prior_rows, problem.prior_target);
  LiftSolution in_parts, other;
  alternation.Run(3, &in_parts);
  other.tau_rad = {0.3, 2.0, 0.1};
  alternation.Run(4, &other);  // another start in between
  alternation.Run(5, &in_parts);
  LiftSolution at_once;
  alternation.Run(8, &at_once);
  EXPECT_EQ(in_parts.history, at_once.history);
  EXPECT_EQ(in_parts.pose_in_body_m, at_once.pose_in_body_m);
}

TEST(Alternation, AConvergedSolutionStays) {
  std::mt19937_64 rng = TestRng();
  Problem problem = RandomProblem(7, &rng);
  problem.options.min_improvement = 0.5;
  LiftSolution solution = Solve(problem, Eigen::Vector3d::Zero(), 1000);
  ASSERT_TRUE(solution.converged);
  Alternation alternation(problem.dictionary, problem.options, problem.observation,
                          problem.prior_rows, problem.prior_target);
  const auto history = solution.history;
  alternation.Run(10, &solution);
  EXPECT_EQ(solution.history, history);
}

}  // namespace
}  // namespace poselift
