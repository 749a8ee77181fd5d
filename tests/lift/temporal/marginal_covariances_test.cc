// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Random Jacobians over frames, against the inverse of the whole normal matrix.
#include "lift/temporal/marginal_covariances.h"

#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>
#include <stdexcept>

#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;

// Of each three frames in a row as many residuals as they have unknowns.
Eigen::MatrixXd RandomJacobian(const std::vector<int>& sizes, std::mt19937_64* rng) {
  Eigen::MatrixXd jacobian(0, std::accumulate(sizes.begin(), sizes.end(), 0));
  Eigen::Index column = 0;
  for (size_t t = 0; t < sizes.size(); ++t) {
    Eigen::Index unknowns = 0;
    for (size_t i = t; i < std::min(t + 3, sizes.size()); ++i) unknowns += sizes[i];
    const Eigen::Index row = jacobian.rows();
    jacobian.conservativeResize(row + unknowns, Eigen::NoChange);
    jacobian.bottomRows(unknowns).setZero();
    jacobian.block(row, column, unknowns, unknowns) = RandomMatrix(unknowns, unknowns, rng);
    column += sizes[t];
  }
  return jacobian;
}

// Zeros are in it as well, as they are in Ceres's blocks.
ceres::CRSMatrix AsRows(const Eigen::MatrixXd& dense) {
  ceres::CRSMatrix rows;
  rows.num_rows = static_cast<int>(dense.rows());
  rows.num_cols = static_cast<int>(dense.cols());
  rows.rows = {0};
  for (int r = 0; r < dense.rows(); ++r) {
    for (int c = static_cast<int>(dense.cols()); c-- > 0;) {
      rows.cols.push_back(c);
      rows.values.push_back(dense(r, c));
    }
    rows.rows.push_back(static_cast<int>(rows.cols.size()));
  }
  return rows;
}

TEST(MarginalCovariances, AreTheDiagonalBlocksOfTheInverse) {
  auto rng = testing::TestRng();
  for (const std::vector<int>& sizes :
       {std::vector{4}, std::vector{3, 5}, std::vector{2, 2, 3}, std::vector{0, 0, 3, 4, 4, 2},
        std::vector{3, 0, 3, 0, 2}, std::vector<int>(11, 4)}) {
    const Eigen::MatrixXd jacobian = RandomJacobian(sizes, &rng);
    const Eigen::MatrixXd inverse = (jacobian.transpose() * jacobian).inverse();
    const auto covariances = MarginalCovariances(AsRows(jacobian), sizes);
    ASSERT_EQ(covariances.size(), sizes.size());
    Eigen::Index at = 0;
    for (size_t t = 0; t < sizes.size(); ++t) {
      EXPECT_TRUE(MatrixNear(covariances[t], inverse.block(at, at, sizes[t], sizes[t]),
                             1e-6 * inverse.norm()));
      at += sizes[t];
    }
  }
}

TEST(MarginalCovariances, WhatNothingTellsOfIsUnsureAndHarmsNoOther) {
  auto rng = testing::TestRng();
  const std::vector<int> sizes = {3, 3, 3};
  Eigen::MatrixXd jacobian = RandomJacobian(sizes, &rng);
  jacobian.col(4).setZero();
  const auto covariances = MarginalCovariances(AsRows(jacobian), sizes);
  ASSERT_EQ(covariances.size(), 3u);
  EXPECT_NEAR(covariances[1](1, 1), 1e9, 1.0);
  EXPECT_LT(covariances[1](0, 0), 1e4);
  EXPECT_LT(covariances[2].norm(), 1e4);
}

TEST(MarginalCovariances, RefusesWhatDoesNotFit) {
  auto rng = testing::TestRng();
  const Eigen::MatrixXd jacobian = RandomMatrix(9, 6, &rng);  // every residual of all frames
  EXPECT_THROW(MarginalCovariances(AsRows(jacobian), {1, 1, 1, 1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(MarginalCovariances(AsRows(jacobian), {3, 2}), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
