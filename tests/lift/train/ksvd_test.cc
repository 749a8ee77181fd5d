// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Poses made of the atoms of a known dictionary, which K-SVD finds again, and
// poses made of nothing in particular.
#include "lift/train/ksvd.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "lift/train/batch_omp.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::MatrixNear;
using testing::RandomAtoms;
using testing::RandomCode;
using testing::RandomMatrix;
using testing::TestRng;

Eigen::MatrixXd SparsePoses(const Eigen::MatrixXd& atoms, int sparsity, int count,
                            std::mt19937_64* rng) {
  Eigen::MatrixXd poses(atoms.rows(), count);
  for (auto pose : poses.colwise())
    pose = Synthesize(atoms, RandomCode(atoms.cols(), sparsity, rng));
  return poses;
}

TEST(Ksvd, FindsMostAtomsOfAPlantedDictionary) {
  std::mt19937_64 rng = TestRng();
  int planted = 0, found = 0, complete = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Eigen::MatrixXd truth = RandomAtoms(69, 20, &rng);
    const Eigen::MatrixXd poses = SparsePoses(truth, 3, 1000, &rng);
    Eigen::MatrixXd atoms = poses.leftCols(20);
    const KsvdReport report =
        TrainKsvd(poses, {.sparsity = 3, .max_iterations = 80, .min_improvement = 0.0}, &atoms);
    const Eigen::VectorXd likeness = (truth.transpose() * atoms).cwiseAbs().rowwise().maxCoeff();
    planted += 20;
    found += static_cast<int>((likeness.array() > 1.0 - 1e-2).count());
    if (report.rms_error_m.back() < 1e-6) ++complete;  // no atom is missing
  }
  EXPECT_GE(found, planted * 4 / 5);
  EXPECT_GE(complete, 1);
}

TEST(Ksvd, ReportedErrorFallsAndIsThatOfTheAtomsReturned) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::MatrixXd poses = RandomMatrix(69, 20, &rng) * RandomMatrix(20, 500, &rng) +
                                  0.3 * RandomMatrix(69, 500, &rng);
    Eigen::MatrixXd atoms = poses.leftCols(60);
    const KsvdReport report =
        TrainKsvd(poses, {.sparsity = 4, .max_iterations = 40, .min_improvement = 0.0}, &atoms);
    const auto& errors = report.rms_error_m;
    ASSERT_GE(errors.size(), 3u);
    for (size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], errors[i - 1]);
    const SparseCodes codes = BatchOmp(atoms, poses, 4);
    EXPECT_NEAR(JointRms_m(CodingErrors(atoms, poses, codes).sum(), 500), errors.back(), 1e-9);
    std::vector<int> uses(60, 0);
    for (int j = 0; j < 500; ++j)
      for (int i = 0; i < codes.sizes[j]; ++i) ++uses[codes.atoms(i, j)];
    EXPECT_EQ(report.atom_use, uses);
  }
}

TEST(Ksvd, AtomsHaveUnitNorm) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd poses = RandomMatrix(69, 200, &rng);
  Eigen::MatrixXd atoms = 17.0 * poses.leftCols(30);
  TrainKsvd(poses, {.sparsity = 3, .max_iterations = 5}, &atoms);
  EXPECT_TRUE(MatrixNear(atoms.colwise().norm(), Eigen::RowVectorXd::Ones(30), 1e-12));
}

// With one atom a pose and exact coding, an update is the best rank-one fit.
TEST(Ksvd, OneAtomIsTheFirstSingularVector) {
  std::mt19937_64 rng = TestRng();
  const Eigen::VectorXd direction = RandomAtoms(69, 1, &rng);
  const Eigen::MatrixXd poses =
      direction * RandomMatrix(1, 200, &rng) + 0.05 * RandomMatrix(69, 200, &rng);
  Eigen::MatrixXd atoms = poses.leftCols(1);
  TrainKsvd(poses, {.sparsity = 1, .max_iterations = 50, .min_improvement = 0.0}, &atoms);
  const Eigen::MatrixXd scatter = poses * poses.transpose();
  const Eigen::VectorXd image = scatter * atoms;
  EXPECT_TRUE(MatrixNear(image.normalized(), atoms.col(0), 1e-6));
  EXPECT_GT(std::abs(atoms.col(0).dot(direction)), 0.99);
}

// Many unused atoms: each takes a different pose.
TEST(Ksvd, UnusedAtomsTakeDifferentPoses) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd poses = RandomMatrix(69, 100, &rng);
  Eigen::MatrixXd atoms = Eigen::MatrixXd::Zero(69, 12);
  atoms.col(0) = poses.col(0);
  TrainKsvd(poses, {.sparsity = 1, .max_iterations = 1, .min_improvement = 0.0}, &atoms);
  EXPECT_TRUE(MatrixNear(atoms.colwise().norm(), Eigen::RowVectorXd::Ones(12), 1e-12));
  Eigen::MatrixXd likeness = atoms.transpose() * atoms;
  likeness.diagonal().setZero();
  EXPECT_LT(likeness.cwiseAbs().maxCoeff(), 0.9);
}

TEST(Ksvd, PosesThatAreAllZeroLeaveTheAtoms) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd start = RandomAtoms(69, 5, &rng);
  Eigen::MatrixXd atoms = start;
  const KsvdReport report = TrainKsvd(Eigen::MatrixXd::Zero(69, 10), {}, &atoms);
  EXPECT_TRUE(MatrixNear(atoms, start, 1e-15));
  EXPECT_EQ(report.rms_error_m.back(), 0.0);
}

TEST(Ksvd, IsDeterministic) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd poses = RandomMatrix(69, 300, &rng);
  Eigen::MatrixXd a = poses.leftCols(40), b = a;
  TrainKsvd(poses, {}, &a);
  TrainKsvd(poses, {}, &b);
  EXPECT_EQ(a, b);
}

TEST(Ksvd, JointRmsIsOverJoints) { EXPECT_NEAR(JointRms_m(23 * 5 * 0.04, 5), 0.2, 1e-15); }

TEST(KsvdOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(KsvdOptions().Validate(), "");
  EXPECT_THAT(KsvdOptions{.sparsity = 0}.Validate(), HasSubstr("sparsity = 0"));
  EXPECT_THAT(KsvdOptions{.max_iterations = 0}.Validate(), HasSubstr("max_iterations = 0"));
  EXPECT_THAT(KsvdOptions{.min_improvement = std::nan("")}.Validate(),
              HasSubstr("min_improvement = nan"));
}

}  // namespace
}  // namespace poselift
