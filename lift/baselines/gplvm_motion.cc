// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/gplvm_motion.h"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "src/input_error.h"

namespace poselift {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kMaxIterations = 30;
constexpr double kFunctionTolerance = 1e-4;

using RowMajorMap =
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

class StyleCost final : public ceres::CostFunction {
 public:
  StyleCost(const Style& style, const FeatureVector& last, double weight)
      : style_(style), last_(last), weight_(weight) {
    const auto dim = static_cast<int>(style.gplvm.mean.size());
    const auto latent_dim = static_cast<int>(style.gplvm.latent.rows());
    set_num_residuals(dim + 1 + latent_dim);
    *mutable_parameter_block_sizes() = {kNumFeatures, latent_dim};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const ScaledGplvm& gplvm = style_.gplvm;
    const Index dim = gplvm.mean.size(), latent_dim = gplvm.latent.rows();
    const Eigen::Map<const FeatureVector> y(parameters[0]);
    x_ = Eigen::Map<const VectorXd>(parameters[1], latent_dim);
    Predict(gplvm, x_, &prediction_);
    const double sigma = std::sqrt(prediction_.variance);
    Eigen::Map<VectorXd> r(residuals, num_residuals());
    auto misfit = r.head(dim);
    misfit = -prediction_.mean;
    misfit.head<kNumFeatures>() += y;
    if (style_.has_changes) misfit.tail<kNumPoseFeatures>() += (y - last_).head<kNumPoseFeatures>();
    misfit = (weight_ / sigma * gplvm.scales.array() * misfit.array()).eval();
    const double log_row =
        std::sqrt(static_cast<double>(dim) * std::log(2.0 * gplvm.beta * prediction_.variance));
    r[dim] = weight_ * log_row;
    r.tail(latent_dim) = weight_ * x_;
    if (!jacobians) return true;
    if (jacobians[0]) {
      RowMajorMap by_y(jacobians[0], num_residuals(), kNumFeatures);
      const VectorXd slopes = weight_ / sigma * gplvm.scales;
      by_y.setZero();
      by_y.topRows<kNumFeatures>() = slopes.head<kNumFeatures>().asDiagonal();
      if (style_.has_changes)
        by_y.block<kNumPoseFeatures, kNumPoseFeatures>(kNumFeatures, 0) =
            slopes.tail<kNumPoseFeatures>().asDiagonal();
    }
    if (jacobians[1]) {
      RowMajorMap by_x(jacobians[1], num_residuals(), latent_dim);
      const auto variance_by_x = prediction_.variance_by_x.transpose();
      by_x.topRows(dim) = -weight_ / sigma * (gplvm.scales.asDiagonal() * prediction_.mean_by_x) -
                          0.5 / prediction_.variance * misfit * variance_by_x;
      by_x.row(dim) = weight_ * 0.5 * static_cast<double>(dim) / (log_row * prediction_.variance) *
                      variance_by_x;
      by_x.bottomRows(latent_dim) = weight_ * Eigen::MatrixXd::Identity(latent_dim, latent_dim);
    }
    return true;
  }

 private:
  const Style& style_;
  FeatureVector last_;
  double weight_;
  mutable VectorXd x_;
  mutable GplvmPrediction prediction_;
};

class PointsCost final : public ceres::CostFunction {
 public:
  explicit PointsCost(FeaturePoints* points) : points_(*points) {
    set_num_residuals(points_.num_rows());
    *mutable_parameter_block_sizes() = {kNumFeatures};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const bool differentiate = jacobians && jacobians[0];
    points_.Evaluate(Eigen::Map<const FeatureVector>(parameters[0]),
                     Eigen::Map<VectorXd>(residuals, num_residuals()),
                     differentiate ? &by_features_ : nullptr);
    if (differentiate) RowMajorMap(jacobians[0], num_residuals(), kNumFeatures) = by_features_;
    return true;
  }

 private:
  FeaturePoints& points_;
  mutable Eigen::MatrixXd by_features_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> MakeStyleCost(const Style& style, const FeatureVector& last,
                                                   double weight) {
  return std::make_unique<StyleCost>(style, last, weight);
}

std::string StyleOptions::Validate() const {
  if (num_frames <= gplvm.latent_dim)
    return fmt::format("StyleOptions::num_frames = {}, wanted more than the latent dimensions",
                       num_frames);
  return gplvm.Validate();
}

Style LearnStyle(const MotionDatabase& database, const StyleOptions& options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  std::vector<int> frames = SegmentEnds(database, 1);  // each is followed by another
  if (frames.size() < static_cast<size_t>(options.num_frames))
    throw InputError(fmt::format("a style of {} frames, but the motions have {}",
                                 options.num_frames, frames.size()));
  std::shuffle(frames.begin(), frames.end(), std::mt19937_64(options.seed));
  frames.resize(static_cast<size_t>(options.num_frames));
  Style style;
  style.has_changes = options.changes;
  style.poses.resize(Eigen::NoChange, options.num_frames);
  Eigen::MatrixXd y(kNumFeatures + (options.changes ? kNumPoseFeatures : 0), options.num_frames);
  for (Index i = 0; i < y.cols(); ++i) {
    const int t = frames[static_cast<size_t>(i)];
    style.poses.col(i) = database.features.col(t + 1).cast<double>();
    y.col(i).head<kNumFeatures>() = style.poses.col(i);
    if (options.changes)
      y.col(i).tail<kNumPoseFeatures>() =
          (style.poses.col(i) - database.features.col(t).cast<double>()).head<kNumPoseFeatures>();
  }
  style.gplvm = TrainScaledGplvm(y, options.gplvm);
  return style;
}

std::string GplvmMotionOptions::Validate() const {
  if (num_starts < 0)
    return fmt::format("GplvmMotionOptions::num_starts = {}, wanted >= 0", num_starts);
  if (!(observed_scale_per_m >= 0.0 && std::isfinite(observed_scale_per_m)))
    return fmt::format("GplvmMotionOptions::observed_scale_per_m = {}, wanted >= 0",
                       observed_scale_per_m);
  if (!(prior_sigma_factor > 0.0 && std::isfinite(prior_sigma_factor)))
    return fmt::format("GplvmMotionOptions::prior_sigma_factor = {}, wanted > 0",
                       prior_sigma_factor);
  return "";
}

GplvmMotion::GplvmMotion(const Style& style, const Skeleton& skeleton, double frame_time_s,
                         const FeatureVector& row_weights, const GplvmMotionOptions& options)
    : style_(style),
      options_(options),
      body_(skeleton),
      frame_time_s_(frame_time_s),
      row_weights_(row_weights),
      points_(body_, frame_time_s) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
}

void GplvmMotion::Begin(const std::vector<SkeletonPose>& first) {
  if (first.size() < 2)
    throw std::invalid_argument(fmt::format("GPLVM: {} first poses, wanted 2", first.size()));
  last_pose_ = first.back();
  last_ = MotionFeatures({body_.skeleton, frame_time_s_, {first.end() - 2, first.end()}}).col(1);
  points_.Observe(last_pose_, {});
  latent_ = style_.gplvm.latent.col(NearestPoses(1).front());
}

SkeletonPose GplvmMotion::Next(const std::vector<TargetPoint>& observed) {
  if (latent_.size() == 0) throw std::invalid_argument("GPLVM: Next before Begin");
  points_.Observe(last_pose_, observed);
  Solution best = Solve(last_, latent_);
  for (const Index i : NearestPoses(options_.num_starts)) {
    Predict(style_.gplvm, style_.gplvm.latent.col(i), &prediction_);
    const Solution other = Solve(prediction_.mean.head<kNumFeatures>(), style_.gplvm.latent.col(i));
    if (other.cost < best.cost) best = other;
  }
  last_ = best.features;
  latent_ = best.latent;
  last_pose_ = PoseFromFeatures(last_, last_pose_, frame_time_s_);
  return last_pose_;
}

std::vector<Index> GplvmMotion::NearestPoses(int count) {
  VectorXd distances =
      (row_weights_.asDiagonal() * (style_.poses.colwise() - last_)).colwise().squaredNorm();
  const double metre = options_.observed_scale_per_m * options_.observed_scale_per_m;
  for (Index i = 0; i < distances.size(); ++i)
    distances[i] += metre * points_.SquaredMisses_m2(style_.poses.col(i));
  std::vector<Index> order(static_cast<size_t>(distances.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return distances[a] < distances[b]; });
  order.resize(std::min(order.size(), static_cast<size_t>(count)));
  return order;
}

GplvmMotion::Solution GplvmMotion::Solve(const FeatureVector& features, const VectorXd& latent) {
  Solution solution{features, latent, 0.0};
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  StyleCost style(style_, last_, 1.0 / options_.prior_sigma_factor);
  PointsCost points(&points_);
  problem.AddResidualBlock(&style, nullptr, solution.features.data(), solution.latent.data());
  if (points_.num_rows() > 0) problem.AddResidualBlock(&points, nullptr, solution.features.data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = kMaxIterations;
  solver.function_tolerance = kFunctionTolerance;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (!summary.IsSolutionUsable())
    return {features, latent, std::numeric_limits<double>::infinity()};
  solution.cost = summary.final_cost;
  return solution;
}

}  // namespace poselift
