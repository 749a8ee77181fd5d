// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Batch OMP against OMP one pose at a time.
#include "lift/train/batch_omp.h"

#include <gtest/gtest.h>

#include "lift/omp.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomAtoms;
using testing::RandomMatrix;
using testing::TestRng;

SparseCode CodeOf(const SparseCodes& codes, Eigen::Index pose) {
  SparseCode code;
  for (int i = 0; i < codes.sizes[pose]; ++i) code.atoms.push_back(codes.atoms(i, pose));
  code.coefficients = codes.coefficients.col(pose).head(codes.sizes[pose]);
  return code;
}

TEST(BatchOmp, IsOmpOfEveryPose) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd atoms = RandomAtoms(69, 150, &rng);
  const Eigen::MatrixXd poses = RandomMatrix(69, 1100, &rng);  // more than two blocks
  const SparseCodes codes = BatchOmp(atoms, poses, 6);
  const Eigen::VectorXd errors = CodingErrors(atoms, poses, codes);
  for (Eigen::Index j = 0; j < poses.cols(); ++j) {
    const SparseCode expected = OrthogonalMatchingPursuit(atoms, poses.col(j), {.max_atoms = 6});
    const SparseCode code = CodeOf(codes, j);
    ASSERT_EQ(code.atoms, expected.atoms);
    ASSERT_TRUE(MatrixNear(code.coefficients, expected.coefficients, 1e-10));
    ASSERT_NEAR(errors[j], (Synthesize(atoms, expected) - poses.col(j)).squaredNorm(), 1e-9);
  }
}

TEST(BatchOmp, PosesThatAreExplainedEarlyUseFewerAtoms) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd atoms = RandomAtoms(69, 40, &rng);
  Eigen::MatrixXd poses = Eigen::MatrixXd::Zero(69, 3);
  poses.col(1) = 3.0 * atoms.col(7);
  poses.col(2) = atoms.col(2) - 2.0 * atoms.col(9);
  const SparseCodes codes = BatchOmp(atoms, poses, 10);
  EXPECT_EQ(codes.sizes[0], 0);
  EXPECT_EQ(codes.sizes[1], 1);
  EXPECT_LT(codes.sizes[2], 10);
  EXPECT_TRUE(codes.coefficients.allFinite());
  EXPECT_LT(CodingErrors(atoms, poses, codes).maxCoeff(), 1e-20);
}

TEST(BatchOmp, AtomsOfNoLengthOrTwiceThereDoNoHarm) {
  std::mt19937_64 rng = TestRng();
  Eigen::MatrixXd atoms = RandomAtoms(69, 8, &rng);
  atoms.rightCols(4) = -atoms.leftCols(4);
  atoms.col(3).setZero();
  atoms.col(7).setZero();
  const Eigen::MatrixXd poses = RandomMatrix(69, 20, &rng);
  const SparseCodes codes = BatchOmp(atoms, poses, 8);
  EXPECT_TRUE(codes.coefficients.allFinite());
  for (const int size : codes.sizes) EXPECT_EQ(size, 3);
}

TEST(BatchOmp, TakesNoMoreAtomsThanThereAre) {
  std::mt19937_64 rng = TestRng();
  const SparseCodes codes = BatchOmp(RandomAtoms(69, 2, &rng), RandomMatrix(69, 5, &rng), 50);
  EXPECT_EQ(codes.atoms.rows(), 2);
}

}  // namespace
}  // namespace poselift
