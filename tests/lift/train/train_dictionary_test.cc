// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up poses in blobs: the bytes do not depend on the threads; the size rule.
#include "lift/train/train_dictionary.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "lift/train/batch_omp.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;

// Poses of a few degrees of freedom about several means.
Eigen::MatrixXd BlobPoses(int count, std::mt19937_64* rng) {
  const Eigen::MatrixXd means = RandomMatrix(69, 4, rng);
  const Eigen::MatrixXd directions = 0.3 * RandomMatrix(69, 8, rng);
  Eigen::MatrixXd poses = directions * RandomMatrix(8, count, rng);
  for (int j = 0; j < count; ++j) poses.col(j) += means.col(j % 4);
  return poses;
}

Eigen::MatrixXd Train(const Eigen::MatrixXd& poses, TrainOptions options, int num_threads) {
  options.num_threads = num_threads;
  TrainReport report;
  return TrainAtoms(poses, options, {}, &report);
}

// Large enough for Eigen to share out a product, one subset so that it could.
TEST(TrainAtoms, BytesDoNotDependOnTheThreads) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd poses = BlobPoses(2500, &rng);
  for (const int num_subsets : {1, 3}) {
    TrainOptions options{.num_atoms = 300, .num_subsets = num_subsets};
    options.ksvd.max_iterations = 2;
    const Eigen::MatrixXd one = Train(poses, options, 1);
    EXPECT_EQ(one, Train(poses, options, 2));
    EXPECT_EQ(one, Train(poses, options, 0));
  }
}

TEST(TrainAtoms, SeedDecidesTheAtoms) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd poses = BlobPoses(400, &rng);
  TrainOptions options{.num_atoms = 40, .num_subsets = 4};
  const Eigen::MatrixXd first = Train(poses, options, 0);
  EXPECT_EQ(first, Train(poses, options, 0));
  options.seed = 2;
  EXPECT_NE(first, Train(poses, options, 0));
}

TEST(TrainAtoms, ReportsTheErrorOfItsAtoms) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd poses = BlobPoses(600, &rng);
  TrainReport report;
  const TrainOptions options{.num_atoms = 48, .num_subsets = 4};
  double last = 0.0;
  const Eigen::MatrixXd atoms = TrainAtoms(
      poses, options,
      [&](double fraction) {
        EXPECT_GT(fraction, last);
        last = fraction;
      },
      &report);
  EXPECT_NEAR(last, 1.0, 1e-12);
  EXPECT_NEAR(static_cast<double>(atoms.cols()), 48.0, 4.0);
  EXPECT_TRUE(MatrixNear(atoms.colwise().norm(), Eigen::RowVectorXd::Ones(atoms.cols()), 1e-12));
  long poses_in_subsets = 0;
  double squared = 0.0;
  for (const SubsetReport& subset : report.subsets) {
    poses_in_subsets += subset.num_poses;
    squared += std::pow(subset.ksvd.rms_error_m.back(), 2) * subset.num_poses;
  }
  EXPECT_EQ(poses_in_subsets, 600);
  EXPECT_NEAR(report.rms_error_m, std::sqrt(squared / 600), 1e-12);
}

TEST(TrainAtoms, MoreSubsetsThanPosesIsASubsetForEach) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd atoms =
      Train(RandomMatrix(69, 5, &rng), {.num_atoms = 100, .num_subsets = 50}, 0);
  EXPECT_EQ(atoms.cols(), 5);
  EXPECT_TRUE(atoms.allFinite());
}

class SizeRule : public ::testing::Test {
 protected:
  SizeRule() : poses_(BlobPoses(700, &rng_)), drawn_(700) {
    std::iota(drawn_.begin(), drawn_.end(), 0);
  }
  // Of all poses, coded over the first n.
  double ErrorWith(int n) const {
    const Eigen::MatrixXd atoms = poses_.leftCols(n).colwise().normalized();
    return JointRms_m(
        CodingErrors(atoms, poses_, BatchOmp(atoms, poses_, options_.ksvd.sparsity)).sum(),
        poses_.cols());
  }

  std::mt19937_64 rng_ = TestRng();
  Eigen::MatrixXd poses_;
  std::vector<int> drawn_;
  TrainOptions options_;
};

TEST_F(SizeRule, IsTheFirstOfItsSeriesThatReachesTheTarget) {
  for (const double target_m : {0.05, 0.1, 0.15}) {
    options_.target_error_m = target_m;
    const int n = AtomsForTarget(poses_, drawn_, options_);
    EXPECT_LE(ErrorWith(n), options_.delta * target_m);
    int before = 0;
    for (int next = options_.first_atoms; next < n; next = static_cast<int>(std::ceil(1.5 * next)))
      before = next;
    EXPECT_TRUE(before == 0 || ErrorWith(before) > options_.delta * target_m);
  }
}

TEST_F(SizeRule, AsksForMoreAtomsForASmallerError) {
  int last = 0;
  for (const double target_m : {0.3, 0.15, 0.1, 0.05}) {
    options_.target_error_m = target_m;
    const int n = AtomsForTarget(poses_, drawn_, options_);
    EXPECT_GE(n, last);
    last = n;
  }
  EXPECT_GT(last, options_.first_atoms);
}

TEST_F(SizeRule, EndsAtAllPosesWhenNoNumberReachesTheTarget) {
  options_.target_error_m = 1e-30;
  EXPECT_EQ(AtomsForTarget(poses_, drawn_, options_), 700);
  options_.first_atoms = 100000;
  EXPECT_EQ(AtomsForTarget(poses_, drawn_, options_), 700);
}

TEST(TrainOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(TrainOptions().Validate(), "");
  EXPECT_THAT(TrainOptions{.num_atoms = -1}.Validate(), HasSubstr("num_atoms = -1"));
  EXPECT_THAT(TrainOptions{.target_error_m = 0}.Validate(), HasSubstr("target_error_m = 0"));
  EXPECT_THAT(TrainOptions{.delta = 0.9}.Validate(), HasSubstr("delta = 0.9"));
  EXPECT_THAT(TrainOptions{.first_atoms = 0}.Validate(), HasSubstr("first_atoms = 0"));
  EXPECT_THAT(TrainOptions{.num_subsets = 0}.Validate(), HasSubstr("num_subsets = 0"));
  EXPECT_THAT(TrainOptions{.num_threads = -2}.Validate(), HasSubstr("num_threads = -2"));
  EXPECT_THAT(TrainOptions{.ksvd = {.sparsity = 0}}.Validate(), HasSubstr("sparsity = 0"));
}

}  // namespace
}  // namespace poselift
