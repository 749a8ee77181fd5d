// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// OMP with constant rows set apart against OMP of the stacked problem, over
// changing upper rows as the lifter has them.
#include "lift/constant_rows.h"

#include <gtest/gtest.h>

#include "lift/omp.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;

TEST(ConstantRows, OmpIsThatOfTheStackedProblem) {
  std::mt19937_64 rng = TestRng();
  constexpr int kAtoms = 60;
  for (const int num_constant : {0, 1, 25}) {
    const Eigen::MatrixXd rows = RandomMatrix(num_constant, kAtoms, &rng);
    const Eigen::VectorXd below = RandomMatrix(num_constant, 1, &rng);
    ConstantRows constant(rows, below);
    OmpSolver apart, together;
    SparseCode code, expected;
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::MatrixXd atoms = RandomMatrix(12, kAtoms, &rng);
      const Eigen::VectorXd target = RandomMatrix(12, 1, &rng);
      Eigen::MatrixXd all_atoms(12 + num_constant, kAtoms);
      Eigen::VectorXd all_target(12 + num_constant);
      all_atoms << atoms, rows;
      all_target << target, below;
      const OmpOptions options{.max_atoms = 9, .ridge = 0.1 * (trial % 3)};
      apart.Solve(atoms, atoms.colwise().squaredNorm(), target, options, &code, &constant);
      together.Solve(all_atoms, all_atoms.colwise().squaredNorm(), all_target, options, &expected);
      EXPECT_EQ(code.atoms, expected.atoms);
      EXPECT_TRUE(MatrixNear(code.coefficients, expected.coefficients, 1e-11));
      EXPECT_NEAR(apart.residual_squared(), together.residual_squared(), 1e-11);
    }
  }
}

TEST(ConstantRows, AlonePoseAProblemOfTheirOwn) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd rows = RandomMatrix(20, 50, &rng);
  const Eigen::VectorXd target = RandomMatrix(20, 1, &rng);
  ConstantRows constant(rows, target);
  OmpSolver solver;
  SparseCode code;
  solver.Solve(Eigen::MatrixXd(0, 50), Eigen::VectorXd::Zero(50), Eigen::VectorXd(0),
               {.max_atoms = 5}, &code, &constant);
  const SparseCode expected = OrthogonalMatchingPursuit(rows, target, {.max_atoms = 5});
  EXPECT_EQ(code.atoms, expected.atoms);
  EXPECT_TRUE(MatrixNear(code.coefficients, expected.coefficients, 1e-12));
}

TEST(ConstantRows, ColumnsAreRightAfterOldOnesWereDropped) {
  std::mt19937_64 rng = TestRng();
  constexpr int kAtoms = 200000;  // 42 columns are more than is kept
  const Eigen::MatrixXd rows = RandomMatrix(1, kAtoms, &rng);
  ConstantRows constant(rows, Eigen::VectorXd::Ones(1));
  for (int atom = 0; atom < 60; ++atom) {
    constant.DropOldColumns();
    const Eigen::VectorXd& column = constant.GramColumn(atom);
    EXPECT_EQ(column[kAtoms - 1], rows(0, atom) * rows(0, kAtoms - 1));
  }
}

}  // namespace
}  // namespace poselift
