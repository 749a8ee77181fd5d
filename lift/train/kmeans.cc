// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/train/kmeans.h"

#include <algorithm>
#include <limits>
#include <random>

namespace poselift {
namespace {

// k-means++: each next centre is a point drawn with the square of its distance
// to the centres so far as weight.
Eigen::MatrixXd SeedCentres(const Eigen::MatrixXd& points, int num_clusters, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  Eigen::MatrixXd centres(points.rows(), num_clusters);
  const Eigen::Index m = points.cols();
  Eigen::Index chosen = std::uniform_int_distribution<Eigen::Index>(0, m - 1)(rng);
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(m, std::numeric_limits<double>::max());
  for (int c = 0; c < num_clusters; ++c) {
    centres.col(c) = points.col(chosen);
    distance =
        distance.cwiseMin((points.colwise() - centres.col(c)).colwise().squaredNorm().transpose());
    double left = std::uniform_real_distribution<double>(0.0, distance.sum())(rng);
    for (chosen = 0; chosen + 1 < m && (left -= distance[chosen]) > 0.0; ++chosen) {
    }
  }
  return centres;
}

// Points are compared with the centres by blocks, as products of matrices.
bool Assign(const Eigen::MatrixXd& points, const Eigen::MatrixXd& centres,
            Eigen::VectorXi* clusters, Eigen::VectorXd* distances) {
  constexpr Eigen::Index kBlock = 128;
  const Eigen::VectorXd half_norms = 0.5 * centres.colwise().squaredNorm().transpose();
  bool changed = false;
#pragma omp parallel for reduction(|| : changed) schedule(static)
  for (Eigen::Index first = 0; first < points.cols(); first += kBlock) {
    const auto block = points.middleCols(first, std::min(kBlock, points.cols() - first));
    Eigen::MatrixXd scores = centres.transpose() * block;
    scores.colwise() -= half_norms;
    for (Eigen::Index i = 0; i < block.cols(); ++i) {
      const Eigen::Index j = first + i;
      Eigen::Index best = 0;
      const double score = scores.col(i).maxCoeff(&best);
      (*distances)[j] = block.col(i).squaredNorm() - 2.0 * score;
      changed = changed || (*clusters)[j] != best;
      (*clusters)[j] = static_cast<int>(best);
    }
  }
  return changed;
}

// The point farthest from its centre among those that do not stand alone.
Eigen::Index FarthestInCompany(const Eigen::VectorXi& clusters, const Eigen::VectorXi& counts,
                               const Eigen::VectorXd& distances) {
  Eigen::Index farthest = -1;
  for (Eigen::Index j = 0; j < clusters.size(); ++j)
    if (counts[clusters[j]] > 1 && (farthest < 0 || distances[j] > distances[farthest]))
      farthest = j;
  return farthest;
}

// Means of the clusters. An empty cluster first takes a far point from another;
// there are at least as many points as clusters, so one is to be had.
void MoveCentres(const Eigen::MatrixXd& points, const Eigen::VectorXd& distances,
                 Eigen::VectorXi* clusters, Eigen::MatrixXd* centres) {
  Eigen::VectorXi counts = Eigen::VectorXi::Zero(centres->cols());
  for (const int c : *clusters) ++counts[c];
  for (int c = 0; c < counts.size(); ++c) {
    if (counts[c] > 0) continue;
    const Eigen::Index taken = FarthestInCompany(*clusters, counts, distances);
    --counts[(*clusters)[taken]];
    (*clusters)[taken] = c;
    counts[c] = 1;
  }
  centres->setZero();
  for (Eigen::Index j = 0; j < points.cols(); ++j) centres->col((*clusters)[j]) += points.col(j);
  for (int c = 0; c < counts.size(); ++c) centres->col(c) /= counts[c];
}

}  // namespace

Eigen::VectorXi KMeans(const Eigen::MatrixXd& points, int num_clusters, int max_iterations,
                       std::uint64_t seed, const ProgressFn& progress) {
  num_clusters = static_cast<int>(std::min<Eigen::Index>(num_clusters, points.cols()));
  Eigen::VectorXi clusters = Eigen::VectorXi::Constant(points.cols(), -1);
  Eigen::VectorXd distances(points.cols());
  Eigen::MatrixXd centres = SeedCentres(points, num_clusters, seed);
  for (int i = 0; i < max_iterations && Assign(points, centres, &clusters, &distances); ++i) {
    MoveCentres(points, distances, &clusters, &centres);
    if (progress) progress(static_cast<double>(i + 1) / max_iterations);
  }
  return clusters;
}

}  // namespace poselift
