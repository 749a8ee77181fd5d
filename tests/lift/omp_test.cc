// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up dictionaries and targets. OMP against the exhaustive search over all
// supports, and what holds for any greedy choice: the residual is orthogonal to
// the chosen atoms, the coefficients are the best on them.
#include "lift/omp.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomAtoms;
using testing::RandomCode;
using testing::RandomMatrix;
using testing::TestRng;

// min_x |A_S x - v|^2 + ridge |x|^2, and its x.
double BestOnSupport(const Eigen::MatrixXd& atoms, const std::vector<int>& support,
                     const Eigen::VectorXd& target, double ridge, Eigen::VectorXd* x) {
  const Eigen::MatrixXd chosen = atoms(Eigen::all, support);
  Eigen::MatrixXd gram = chosen.transpose() * chosen;
  gram.diagonal().array() += ridge;
  *x = gram.ldlt().solve(chosen.transpose() * target);
  return (chosen * *x - target).squaredNorm() + ridge * x->squaredNorm();
}

// The least objective over all supports of `size` atoms.
double ExhaustiveSearch(const Eigen::MatrixXd& atoms, int size, const Eigen::VectorXd& target,
                        double ridge) {
  std::vector<bool> in_support(static_cast<size_t>(atoms.cols()));
  std::fill_n(in_support.begin(), size, true);
  double best = std::numeric_limits<double>::infinity();
  do {
    std::vector<int> support;
    for (int k = 0; k < atoms.cols(); ++k)
      if (in_support[k]) support.push_back(k);
    Eigen::VectorXd x;
    best = std::min(best, BestOnSupport(atoms, support, target, ridge, &x));
  } while (std::prev_permutation(in_support.begin(), in_support.end()));
  return best;
}

// Atoms of unequal norms, as a mask leaves them.
Eigen::MatrixXd UnevenAtoms(Eigen::Index rows, Eigen::Index cols, std::mt19937_64* rng) {
  Eigen::MatrixXd atoms = RandomAtoms(rows, cols, rng);
  for (auto atom : atoms.colwise()) atom *= std::uniform_real_distribution<double>(0.1, 3.0)(*rng);
  return atoms;
}

Eigen::VectorXd DenseCode(const SparseCode& code, Eigen::Index num_atoms) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(num_atoms);
  x(code.atoms) = code.coefficients;
  return x;
}

TEST(Omp, FindsTheTrueSupportOfIncoherentAtomsAsExhaustiveSearchDoes) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 30; ++trial) {
    // Two orthonormal bases: coherence 1/sqrt(64), so OMP is right for
    // |x|_0 < (1 + 8) / 2 (Tropp 2004).
    Eigen::MatrixXd atoms(64, 128);
    atoms.leftCols(64).setIdentity();
    for (int i = 0; i < 64; ++i)
      for (int j = 0; j < 64; ++j)
        atoms(i, 64 + j) = (__builtin_popcount(i & j) % 2 == 0 ? 1.0 : -1.0) / 8.0;
    const SparseCode truth = RandomCode(128, 4, &rng);
    const Eigen::VectorXd target = Synthesize(atoms, truth);
    const SparseCode found = OrthogonalMatchingPursuit(atoms, target, {.max_atoms = 4});
    EXPECT_TRUE(MatrixNear(DenseCode(found, 128), DenseCode(truth, 128), 1e-12));
  }
}

TEST(Omp, IsNeverBetterThanExhaustiveSearchAndOftenAsGood) {
  std::mt19937_64 rng = TestRng();
  int equal = 0;
  constexpr int kTrials = 60;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::MatrixXd atoms = UnevenAtoms(8, 10, &rng);
    const Eigen::VectorXd target = RandomMatrix(8, 1, &rng);
    const double ridge = trial % 2 == 0 ? 0.0 : 0.3;
    const SparseCode code =
        OrthogonalMatchingPursuit(atoms, target, {.max_atoms = 3, .ridge = ridge});
    const double objective =
        (Synthesize(atoms, code) - target).squaredNorm() + ridge * code.coefficients.squaredNorm();
    const double best = ExhaustiveSearch(atoms, 3, target, ridge);
    EXPECT_GE(objective, best - 1e-12);
    if (objective < best + 1e-12) ++equal;
  }
  EXPECT_GE(equal, kTrials / 4);
  EXPECT_LT(equal, kTrials);  // it is greedy
}

TEST(Omp, FirstAtomIsTheBestSingleAtomWhateverTheNorms) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd atoms = UnevenAtoms(9, 20, &rng);
    const Eigen::VectorXd target = RandomMatrix(9, 1, &rng);
    const double ridge = 0.5 * trial / 50;
    const SparseCode code =
        OrthogonalMatchingPursuit(atoms, target, {.max_atoms = 1, .ridge = ridge});
    Eigen::VectorXd x;
    const double objective = BestOnSupport(atoms, code.atoms, target, ridge, &x);
    EXPECT_NEAR(objective, ExhaustiveSearch(atoms, 1, target, ridge), 1e-12);
  }
}

TEST(Omp, ResidualIsOrthogonalToTheChosenAtoms) {
  std::mt19937_64 rng = TestRng();
  for (int size = 1; size <= 12; ++size) {
    const Eigen::MatrixXd atoms = UnevenAtoms(30, 100, &rng);
    const Eigen::VectorXd target = RandomMatrix(30, 1, &rng);
    const SparseCode code = OrthogonalMatchingPursuit(atoms, target, {.max_atoms = size});
    ASSERT_EQ(code.atoms.size(), static_cast<size_t>(size));
    const Eigen::VectorXd residual = target - Synthesize(atoms, code);
    EXPECT_TRUE(MatrixNear(atoms(Eigen::all, code.atoms).transpose() * residual,
                           Eigen::VectorXd::Zero(size), 1e-12));
  }
}

TEST(Omp, CoefficientsMinimiseTheRidgeObjectiveOnTheirSupport) {
  std::mt19937_64 rng = TestRng();
  for (const double ridge : {1e-3, 0.1, 10.0}) {
    const Eigen::MatrixXd atoms = UnevenAtoms(20, 50, &rng);
    const Eigen::VectorXd target = RandomMatrix(20, 1, &rng);
    const SparseCode code =
        OrthogonalMatchingPursuit(atoms, target, {.max_atoms = 6, .ridge = ridge});
    Eigen::VectorXd x;
    BestOnSupport(atoms, code.atoms, target, ridge, &x);
    EXPECT_TRUE(MatrixNear(code.coefficients, x, 1e-12));
  }
}

TEST(Omp, TurningAtomsRoundTurnsOnlyTheirCoefficients) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd atoms = UnevenAtoms(20, 40, &rng);
  const Eigen::VectorXd target = RandomMatrix(20, 1, &rng);
  const SparseCode code = OrthogonalMatchingPursuit(atoms, target, {.max_atoms = 5});
  const SparseCode negative = OrthogonalMatchingPursuit(-atoms, target, {.max_atoms = 5});
  EXPECT_EQ(code.atoms, negative.atoms);
  EXPECT_TRUE(MatrixNear(code.coefficients, -negative.coefficients, 1e-13));
}

TEST(Omp, StopsAtTheAskedResidual) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd atoms = RandomAtoms(40, 60, &rng);
  const Eigen::VectorXd target = RandomMatrix(40, 1, &rng);
  const double stop = 0.5 * target.squaredNorm();
  const OmpOptions options{.max_atoms = 40, .stop_residual_squared = stop};
  OmpSolver solver;
  SparseCode code;
  solver.Solve(atoms, atoms.colwise().squaredNorm(), target, options, &code);
  EXPECT_LE(solver.residual_squared(), stop);
  EXPECT_NEAR(solver.residual_squared(), (Synthesize(atoms, code) - target).squaredNorm(), 1e-12);
  solver.Solve(atoms, atoms.colwise().squaredNorm(), target,
               {.max_atoms = static_cast<int>(code.atoms.size()) - 1}, &code);
  EXPECT_GT(solver.residual_squared(), stop);
}

TEST(Omp, NeverTakesAnAtomThatIsNotSeen) {
  std::mt19937_64 rng = TestRng();
  Eigen::MatrixXd atoms = RandomAtoms(10, 30, &rng);
  for (int k = 0; k < 30; k += 2) atoms.col(k) *= k % 4 == 0 ? 0.0 : 1e-9;
  const SparseCode code =
      OrthogonalMatchingPursuit(atoms, RandomMatrix(10, 1, &rng), {.max_atoms = 8});
  EXPECT_EQ(code.atoms.size(), 8u);
  for (const int atom : code.atoms) EXPECT_EQ(atom % 2, 1);
}

TEST(Omp, AllAtomsUnseenGiveAnEmptyCode) {
  const SparseCode code =
      OrthogonalMatchingPursuit(Eigen::MatrixXd::Zero(5, 7), Eigen::VectorXd::Ones(5), {});
  EXPECT_TRUE(code.Empty());
  EXPECT_EQ(code.coefficients.size(), 0);
}

TEST(Omp, NoTargetNoRowsOrNoAtomsGiveAnEmptyCode) {
  std::mt19937_64 rng = TestRng();
  EXPECT_TRUE(
      OrthogonalMatchingPursuit(RandomAtoms(5, 7, &rng), Eigen::VectorXd::Zero(5), {}).Empty());
  EXPECT_TRUE(OrthogonalMatchingPursuit(Eigen::MatrixXd(0, 7), Eigen::VectorXd(0), {}).Empty());
  EXPECT_TRUE(
      OrthogonalMatchingPursuit(Eigen::MatrixXd(5, 0), Eigen::VectorXd::Ones(5), {}).Empty());
}

// Thousands of copies: a product with all atoms for each would take minutes.
TEST(Omp, TakesOneOfManyEqualAtoms) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd two = RandomAtoms(40, 2, &rng);
  Eigen::MatrixXd atoms(40, 20000);
  for (int k = 0; k < atoms.cols(); ++k) atoms.col(k) = (k % 3 == 0 ? -2.0 : 1.0) * two.col(k % 2);
  const Eigen::VectorXd target = RandomMatrix(40, 1, &rng);
  const SparseCode code = OrthogonalMatchingPursuit(atoms, target, {.max_atoms = 12});
  ASSERT_EQ(code.atoms.size(), 2u);
  EXPECT_NE(code.atoms[0] % 2, code.atoms[1] % 2);
  EXPECT_TRUE(code.coefficients.allFinite());
}

TEST(Omp, EndsWhenTheTargetIsExplained) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd atoms = RandomAtoms(40, 80, &rng);
  const SparseCode truth = RandomCode(80, 3, &rng);
  const SparseCode code =
      OrthogonalMatchingPursuit(atoms, Synthesize(atoms, truth), {.max_atoms = 30});
  EXPECT_LT(code.atoms.size(), 12u);
  EXPECT_TRUE(MatrixNear(Synthesize(atoms, code), Synthesize(atoms, truth), 1e-12));
}

TEST(Omp, MoreAtomsThanRowsAreNotTaken) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd atoms = RandomAtoms(6, 50, &rng);
  const Eigen::VectorXd target = RandomMatrix(6, 1, &rng);
  const SparseCode code = OrthogonalMatchingPursuit(atoms, target, {.max_atoms = 1000000000});
  EXPECT_LE(code.atoms.size(), 6u);
  EXPECT_TRUE(MatrixNear(Synthesize(atoms, code), target, 1e-10));
}

TEST(Omp, SolverIsTheSameAfterOtherProblems) {
  std::mt19937_64 rng = TestRng();
  OmpSolver used;
  SparseCode first, second;
  for (const int rows : {30, 4, 50, 12}) {
    const Eigen::MatrixXd atoms = UnevenAtoms(rows, 3 * rows, &rng);
    const Eigen::VectorXd norms = atoms.colwise().squaredNorm();
    const Eigen::VectorXd target = RandomMatrix(rows, 1, &rng);
    used.Solve(atoms, norms, target, {.max_atoms = 6}, &first);
    OmpSolver().Solve(atoms, norms, target, {.max_atoms = 6}, &second);
    EXPECT_EQ(first.atoms, second.atoms);
    EXPECT_EQ(first.coefficients, second.coefficients);
  }
}

TEST(OmpOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(OmpOptions().Validate(), "");
  EXPECT_THAT(OmpOptions{.max_atoms = 0}.Validate(), ::testing::HasSubstr("max_atoms = 0"));
  EXPECT_THAT((OmpOptions{.ridge = -1.0}.Validate()), ::testing::HasSubstr("ridge = -1"));
  EXPECT_THAT((OmpOptions{.stop_residual_squared = std::nan("")}.Validate()),
              ::testing::HasSubstr("stop_residual_squared = nan"));
}

}  // namespace
}  // namespace poselift
