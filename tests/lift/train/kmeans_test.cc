// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up clouds: blobs that are found again, points that are alike, more
// clusters than points.
#include "lift/train/kmeans.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::RandomMatrix;
using testing::TestRng;

int NumUsed(const Eigen::VectorXi& clusters) {
  return static_cast<int>(std::set<int>(clusters.begin(), clusters.end()).size());
}

Eigen::MatrixXd Means(const Eigen::MatrixXd& points, const Eigen::VectorXi& clusters) {
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(points.rows(), clusters.maxCoeff() + 1);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(means.cols());
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    means.col(clusters[j]) += points.col(j);
    counts[clusters[j]] += 1.0;
  }
  return means * counts.cwiseInverse().asDiagonal();
}

TEST(KMeans, EveryPointIsInTheClusterOfTheNearestMean) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd points = RandomMatrix(5, 300, &rng);
  const Eigen::VectorXi clusters = KMeans(points, 9, 200, 1);
  const Eigen::MatrixXd means = Means(points, clusters);
  EXPECT_EQ(NumUsed(clusters), 9);
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    const double nearest = (means.colwise() - points.col(j)).colwise().squaredNorm().minCoeff();
    EXPECT_NEAR((means.col(clusters[j]) - points.col(j)).squaredNorm(), nearest, 1e-12);
  }
}

TEST(KMeans, FindsBlobsThatAreFarApart) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd centres = 100.0 * RandomMatrix(69, 6, &rng);
  Eigen::MatrixXd points = RandomMatrix(69, 300, &rng);
  for (int j = 0; j < 300; ++j) points.col(j) += centres.col(j % 6);
  const Eigen::VectorXi clusters = KMeans(points, 6, 30, 1);
  EXPECT_EQ(NumUsed(clusters), 6);
  for (int j = 6; j < 300; ++j) EXPECT_EQ(clusters[j], clusters[j - 6]);
}

TEST(KMeans, NoClusterIsEmptyWhenPointsAreAlike) {
  std::mt19937_64 rng = TestRng();
  for (const int different : {1, 2, 3})
    for (const int iterations : {1, 2, 30}) {
      const Eigen::MatrixXd few = RandomMatrix(4, different, &rng);
      Eigen::MatrixXd points(4, 12);
      for (int j = 0; j < 12; ++j) points.col(j) = few.col(j % different);
      for (const int wanted : {2, 5, 12})
        EXPECT_EQ(NumUsed(KMeans(points, wanted, iterations, 3)), wanted);
    }
}

TEST(KMeans, MoreClustersThanPointsIsAClusterForEachPoint) {
  std::mt19937_64 rng = TestRng();
  const Eigen::VectorXi clusters = KMeans(RandomMatrix(4, 7, &rng), 100, 30, 1);
  EXPECT_EQ(NumUsed(clusters), 7);
  EXPECT_EQ(clusters.maxCoeff(), 6);
  EXPECT_EQ(clusters.minCoeff(), 0);
}

TEST(KMeans, OneClusterHoldsAll) {
  std::mt19937_64 rng = TestRng();
  EXPECT_TRUE((KMeans(RandomMatrix(4, 50, &rng), 1, 30, 1).array() == 0).all());
}

TEST(KMeans, SameSeedSameClusters) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd points = RandomMatrix(8, 500, &rng);
  EXPECT_EQ(KMeans(points, 12, 30, 5), KMeans(points, 12, 30, 5));
  EXPECT_NE(KMeans(points, 12, 30, 5), KMeans(points, 12, 30, 6));
}

}  // namespace
}  // namespace poselift
