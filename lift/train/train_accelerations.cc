// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/train/train_accelerations.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <atomic>

#include "lift/temporal/acceleration_model.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr Eigen::Index kBlock = 64;
// A principal direction that so small a part of the variance is left for is none.
constexpr double kLeastVariance = 1e-9;

// The nearest of all, nearest first, none within `apart` columns of another.
std::vector<Eigen::Index> NearestApart(const Eigen::Ref<const Eigen::VectorXf>& distances,
                                       int count, int apart) {
  // Each that is taken keeps no more than 2 (apart - 1) others away.
  const auto enough =
      std::min<std::ptrdiff_t>(distances.size(), std::ptrdiff_t{count} * (2 * apart - 1));
  std::vector<float> sorted(distances.begin(), distances.end());
  std::nth_element(sorted.begin(), sorted.begin() + (enough - 1), sorted.end());
  const float farthest = sorted[static_cast<size_t>(enough - 1)];
  std::vector<Eigen::Index> order;
  for (Eigen::Index k = 0; k < distances.size(); ++k)
    if (distances[k] <= farthest) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return distances[a] < distances[b]; });
  std::vector<Eigen::Index> nearest;
  std::vector<bool> is_taken(static_cast<size_t>(distances.size()), false);
  for (const Eigen::Index k : order) {
    if (std::ssize(nearest) == count) break;
    const auto first = std::max<Eigen::Index>(0, k - apart + 1);
    const auto end = std::min<Eigen::Index>(distances.size(), k + apart);
    if (std::find(is_taken.begin() + first, is_taken.begin() + end, true) != is_taken.begin() + end)
      continue;
    is_taken[static_cast<size_t>(k)] = true;
    nearest.push_back(k);
  }
  return nearest;
}

// x and y of the neighbours; weights of sum 1.
void FitModel(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::VectorXd& weights,
              const Eigen::VectorXd& centre, const Eigen::VectorXd& metric, Eigen::Index column,
              AccelerationModels* models) {
  const Eigen::VectorXd mean_x = x * weights, mean_y = y * weights;
  const Eigen::VectorXd roots = weights.cwiseSqrt();
  const Eigen::MatrixXd scaled = metric.asDiagonal() * (x.colwise() - mean_x) * roots.asDiagonal();
  const Eigen::MatrixXd centred = (y.colwise() - mean_y) * roots.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled * scaled.transpose());
  const Eigen::VectorXd& variances = eigen.eigenvalues();  // ascending

  Eigen::VectorXd mean = mean_y;
  Eigen::MatrixXd residuals = centred;
  int used = 0;
  for (; used < kAccelerationRank; ++used) {
    const Eigen::Index i = variances.size() - 1 - used;
    if (!(variances[i] > kLeastVariance * variances.sum())) break;
    const Eigen::VectorXd direction = metric.cwiseProduct(eigen.eigenvectors().col(i));
    const Eigen::RowVectorXd scores = eigen.eigenvectors().col(i).transpose() * scaled;
    const Eigen::VectorXd response = centred * scores.transpose() / variances[i];
    residuals -= response * scores;
    mean += response * direction.dot(centre - mean_x);
    models->directions.col(column).segment(used * kAccelerationInputs, kAccelerationInputs) =
        direction.cast<float>();
    models->responses.col(column).segment(used * kNumFeatures, kNumFeatures) =
        response.cast<float>();
  }
  models->means.col(column) = mean.cast<float>();
  const double effective = 1.0 / weights.squaredNorm();
  const double left = std::max(1.0, effective - 1.0 - used);
  models->deviations.col(column) =
      (residuals.rowwise().squaredNorm() * (effective / left)).cwiseSqrt().cast<float>();
}

}  // namespace

std::string AccelerationOptions::Validate() const {
  if (num_neighbours < 1)
    return fmt::format("AccelerationOptions::num_neighbours = {}, wanted at least 1",
                       num_neighbours);
  if (!(bandwidth > 0.0))
    return fmt::format("AccelerationOptions::bandwidth = {}, wanted > 0", bandwidth);
  if (apart < 1) return fmt::format("AccelerationOptions::apart = {}, wanted at least 1", apart);
  return "";
}

void TrainAccelerations(const MotionCodebook& captured, const AccelerationOptions& options,
                        const ProgressFn& progress, MotionCodebook* codebook) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  const MotionCodebook both = WithMirrored(captured);
  const Eigen::VectorXd metric = AccelerationMetric(*codebook);
  const Eigen::MatrixXf x = metric.cast<float>().asDiagonal() * both.AccelerationInputs();
  const Eigen::MatrixXf centres =
      metric.cast<float>().asDiagonal() * codebook->AccelerationInputs();
  const Eigen::VectorXf half_norms = 0.5f * x.colwise().squaredNorm().transpose();
  const Eigen::Index count = centres.cols();
  AccelerationModels& models = codebook->accelerations;
  models = AccelerationModels::Zero(count);

  std::atomic<Eigen::Index> done = 0;
#pragma omp parallel for schedule(dynamic)
  for (Eigen::Index first = 0; first < count; first += kBlock) {
    const Eigen::Index size = std::min(kBlock, count - first);
    const Eigen::MatrixXf products = x.transpose() * centres.middleCols(first, size);
    for (Eigen::Index c = 0; c < size; ++c) {
      const Eigen::VectorXf distances = half_norms - products.col(c);  // half, but for a constant
      const std::vector<Eigen::Index> near =
          NearestApart(distances, options.num_neighbours, options.apart);
      Eigen::MatrixXd near_x = x(Eigen::all, near).cast<double>();
      const Eigen::VectorXd centre = centres.col(first + c).cast<double>();
      const Eigen::VectorXd squared = (near_x.colwise() - centre).colwise().squaredNorm();
      const double h2 = options.bandwidth * options.bandwidth * squared.maxCoeff();
      Eigen::VectorXd weights = Eigen::VectorXd::Ones(squared.size());
      if (h2 > 0.0) weights = (-(squared.array() - squared.minCoeff()) / (2.0 * h2)).exp();
      near_x = metric.cwiseInverse().asDiagonal() * near_x;
      FitModel(near_x, both.accelerations.means(Eigen::all, near).cast<double>(),
               weights / weights.sum(), metric.cwiseInverse().cwiseProduct(centre), metric,
               first + c, &models);
    }
    done += size;
    if (progress) progress(static_cast<double>(done) / static_cast<double>(count));
  }
}

}  // namespace poselift
