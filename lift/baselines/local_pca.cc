// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/local_pca.h"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "src/input_error.h"

namespace poselift {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kFunctionTolerance = 1e-5;
constexpr double kLeastVariance = 1e-8;  // of the weighted features

// How many poses the smoothness looks back on.
constexpr int kSmoothnessFrames = 2;

// One frame's residuals by w: control, prior, smoothness.
class SubspaceCost final : public ceres::CostFunction {
 public:
  struct Terms {
    const FeatureVector& mean;
    const Eigen::MatrixXd& directions;  // 46 x B
    Eigen::VectorXd prior_weights;      // B
    FeatureVector expected;             // 2 y_{t-1} - y_{t-2}
    FeatureVector smoothness_weights;
  };

  SubspaceCost(FeaturePoints* points, const Terms& terms) : points_(*points), terms_(terms) {
    const auto size = static_cast<int>(terms.directions.cols());
    set_num_residuals(points_.num_rows() + size + kNumFeatures);
    *mutable_parameter_block_sizes() = {size};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Index rows = points_.num_rows(), size = terms_.directions.cols();
    const Eigen::Map<const Eigen::VectorXd> w(parameters[0], size);
    const FeatureVector y = terms_.mean + terms_.directions * w;
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    const bool differentiate = jacobians && jacobians[0];
    points_.Evaluate(y, r.head(rows), differentiate ? &by_features_ : nullptr);
    r.segment(rows, size) = terms_.prior_weights.cwiseProduct(w);
    r.tail<kNumFeatures>() = terms_.smoothness_weights.cwiseProduct(y - terms_.expected);
    if (!differentiate) return true;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(
        jacobians[0], num_residuals(), size);
    J.topRows(rows).noalias() = by_features_ * terms_.directions;
    J.middleRows(rows, size) = terms_.prior_weights.asDiagonal();
    J.bottomRows<kNumFeatures>() = terms_.smoothness_weights.asDiagonal() * terms_.directions;
    return true;
  }

 private:
  FeaturePoints& points_;
  Terms terms_;
  mutable Eigen::MatrixXd by_features_;
};

// Where the features would go at a steady pace.
FeatureVector SteadyNext(const FeatureMatrix& past) {
  const auto last = past.col(past.cols() - 1);
  FeatureVector next = 2.0 * last - past.col(past.cols() - 2);
  next.tail<3>() = last.tail<3>();
  return next;
}

}  // namespace

std::string LocalPcaOptions::Validate() const {
  if (num_neighbours < 2)
    return fmt::format("LocalPcaOptions::num_neighbours = {}, wanted at least 2", num_neighbours);
  if (!(observed_scale_per_m >= 0.0 && std::isfinite(observed_scale_per_m)))
    return fmt::format("LocalPcaOptions::observed_scale_per_m = {}, wanted >= 0",
                       observed_scale_per_m);
  if (!(variance_kept > 0.0 && variance_kept <= 1.0))
    return fmt::format("LocalPcaOptions::variance_kept = {}, wanted more than 0, at most 1",
                       variance_kept);
  const std::pair<const char*, double> sizes[] = {{"prior_sigma_factor", prior_sigma_factor},
                                                  {"smoothness_sigma", smoothness_sigma}};
  for (const auto& [name, size] : sizes)
    if (!(size > 0.0 && std::isfinite(size)))
      return fmt::format("LocalPcaOptions::{} = {}, wanted > 0", name, size);
  return "";
}

LocalPca::LocalPca(const MotionDatabase& database, const SegmentSearch& search,
                   const LocalPcaOptions& options)
    : database_(database),
      search_(search),
      options_(options),
      body_(database.skeleton),
      points_(body_, database.frame_time_s) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
}

void LocalPca::Begin(const std::vector<SkeletonPose>& first) {
  const int frames = std::max(search_.options().num_frames, kSmoothnessFrames);
  const size_t wanted = static_cast<size_t>(frames) + 1;  // the velocity of the oldest
  if (first.size() < wanted)
    throw std::invalid_argument(
        fmt::format("local PCA: {} first poses, wanted {}", first.size(), wanted));
  past_.assign(first.end() - static_cast<std::ptrdiff_t>(wanted), first.end());
  cursor_ = {};
}

SkeletonPose LocalPca::Next(const std::vector<TargetPoint>& observed) {
  if (past_.empty()) throw std::invalid_argument("local PCA: Next before Begin");
  const FeatureMatrix past = MotionFeatures({database_.skeleton, database_.frame_time_s, past_});
  points_.Observe(past_.back(), observed);
  FindExamples(past);
  FeatureVector next = SteadyNext(past);
  if (examples_.cols() > 0) {
    FitSubspace();
    next = Solve(past);
  }
  const SkeletonPose pose = PoseFromFeatures(next, past_.back(), database_.frame_time_s);
  past_.erase(past_.begin());
  past_.push_back(pose);
  return past_.back();
}

void LocalPca::FindExamples(const FeatureMatrix& past) {
  search_.FindNearest(past.rightCols(search_.options().num_frames), &cursor_, &matches_);
  const auto count = static_cast<Eigen::Index>(matches_.size());
  const double metre = options_.observed_scale_per_m * options_.observed_scale_per_m;
  candidates_.resize(kNumFeatures, count);
  distances_.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SegmentMatch& match = matches_[static_cast<size_t>(k)];
    candidates_.col(k) = database_.features.col(match.end_frame + 1).cast<double>();
    distances_[k] = match.squared_distance + metre * points_.SquaredMisses_m2(candidates_.col(k));
  }
  std::vector<Eigen::Index> order(matches_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return distances_[a] < distances_[b]; });
  order.resize(std::min(order.size(), static_cast<size_t>(options_.num_neighbours)));
  examples_ = candidates_(Eigen::all, order);
}

void LocalPca::FitSubspace() {
  const FeatureVector& weights = search_.row_weights();
  mean_ = examples_.rowwise().mean();
  const Eigen::MatrixXd centred = weights.asDiagonal() * (examples_.colwise() - mean_);
  eigen_.compute(centred * centred.transpose() / static_cast<double>(examples_.cols()));
  // Ascending: as many of the last as hold the wanted part of their sum.
  const Eigen::VectorXd& variances = eigen_.eigenvalues();
  const double total = variances.sum();
  Eigen::Index size = 0;
  for (double sum = 0.0; size < kNumFeatures && sum < options_.variance_kept * total; ++size)
    sum += variances[kNumFeatures - 1 - size];
  size = std::max<Eigen::Index>(size, 1);
  directions_ = weights.cwiseInverse().asDiagonal() * eigen_.eigenvectors().rightCols(size);
  stddevs_ = variances.tail(size).cwiseMax(kLeastVariance).cwiseSqrt();
}

FeatureVector LocalPca::Solve(const FeatureMatrix& past) {
  FeatureVector smoothness = FeatureVector::Constant(1.0 / options_.smoothness_sigma);
  smoothness.tail<3>() *= database_.frame_time_s;
  SubspaceCost cost(&points_,
                    {mean_, directions_, (options_.prior_sigma_factor * stddevs_).cwiseInverse(),
                     SteadyNext(past), smoothness});
  const FeatureVector& weights = search_.row_weights();
  // The directions are orthonormal over the row weights.
  const Eigen::VectorXd start =
      (weights.cwiseAbs2().asDiagonal() * directions_).transpose() * (examples_.col(0) - mean_);
  Eigen::VectorXd w = start;
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, w.data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.initial_trust_region_radius = 1e6;
  solver.max_num_iterations = kMaxIterations;
  solver.function_tolerance = kFunctionTolerance;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return mean_ + directions_ * (summary.IsSolutionUsable() ? w : start);
}

}  // namespace poselift
