// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/local_regression.h"

#include <fmt/format.h>

#include <Eigen/Householder>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/input_error.h"

namespace poselift {
namespace {

// Against the largest: far neighbours keep a weight, so that leaving one out
// never leaves nothing.
constexpr double kLeastWeight = 1e-12;

// A direction this short (squared) against the longest is not there.
constexpr double kSingular = 1e-12;

// Against the largest eigenvalue.
constexpr std::array kRidges = {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0};

// Scores that explain an output leave its neighbours no say of their own.
constexpr double kLeastLeverageLeft = 1e-3;

void RequireSizes(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::VectorXd& query,
                  const LocalRegressionOptions& options) {
  const auto scales = options.row_scales.size();
  if (x.cols() < 1 || y.cols() != x.cols() || query.size() != x.rows() ||
      (scales != 0 && scales != x.rows()))
    throw InputError(fmt::format(
        "local regression: found x {} x {}, y {} x {}, query {}, row_scales {}, wanted P x K, "
        "D x K, P and P or none, K at least 1",
        x.rows(), x.cols(), y.rows(), y.cols(), query.size(), scales));
  if (options.velocity_scale > 0.0 && (y.rows() == 0 || x.rows() % y.rows() != 0))
    throw InputError(
        fmt::format("local regression: found x of {} rows, wanted whole poses of {} dofs; or set "
                    "velocity_scale "
                    "to 0",
                    x.rows(), y.rows()));
  if (x.rows() < static_cast<int>(options.target) * y.rows())
    throw InputError(
        fmt::format("local regression: found x of {} rows, wanted at least the last {} pose(s) of "
                    "{} dofs for this RegressionTarget",
                    x.rows(), static_cast<int>(options.target), y.rows()));
}

// What a target is counted from, of one or all columns of x.
template <typename Derived>
auto LastPose(const Eigen::MatrixBase<Derived>& x, Eigen::Index dofs) {
  return x.topRows(dofs);
}
template <typename Derived>
auto Extrapolated(const Eigen::MatrixBase<Derived>& x, Eigen::Index dofs) {
  return 2.0 * x.topRows(dofs) - x.middleRows(dofs, dofs);
}

}  // namespace

std::string LocalRegressionOptions::Validate() const {
  const auto wrong = [](const char* name, double value, const char* wanted) {
    return fmt::format("LocalRegressionOptions::{} = {}, wanted {}", name, value, wanted);
  };
  if (!(bandwidth > 0.0)) return wrong("bandwidth", bandwidth, "more than 0");
  if (!(velocity_scale >= 0.0)) return wrong("velocity_scale", velocity_scale, "at least 0");
  if (num_components < 0) return wrong("num_components", num_components, "at least 0");
  if (max_components < 1) return wrong("max_components", max_components, "at least 1");
  if (!(least_stddev > 0.0)) return wrong("least_stddev", least_stddev, "more than 0");
  if (!(shrinkage > 0.0 && shrinkage <= 1.0))
    return wrong("shrinkage", shrinkage, "more than 0 and at most 1");
  if (!row_scales.allFinite()) return "LocalRegressionOptions::row_scales are not all finite";
  return "";
}

void LocalRegression::Solve(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y,
                            const Eigen::VectorXd& query, const LocalRegressionOptions& options,
                            LocalPrediction* prediction) {
  RequireSizes(x, y, query, options);
  Weigh(x, query, y.rows(), options);
  Centre(x, y, options.target);
  Decompose();

  prediction->ridge = 0.0;
  prediction->mean = reflected_mean_ * y_.col(0);
  switch (options.method) {
    case LocalRegressionMethod::kAsPrinted:
      UseLeading(static_cast<int>(eigenvalues_.size()));
      PredictByDirections(prediction);
      break;
    case LocalRegressionMethod::kRidge:
      prediction->ridge = ChooseRidge();
      PredictByDirections(prediction);
      break;
    case LocalRegressionMethod::kPartialLeastSquares:
      SolvePartialLeastSquares(options, prediction);
      break;
    case LocalRegressionMethod::kPrincipalComponents:
      UseLeading(options.num_components > 0 ? options.num_components : ChooseLeading(options));
      PredictByDirections(prediction);
      break;
    case LocalRegressionMethod::kMean:
      UseLeading(0);
      PredictByDirections(prediction);
      break;
  }
  if (options.target == RegressionTarget::kChange) prediction->mean += LastPose(query, y.rows());
  if (options.target == RegressionTarget::kAcceleration)
    prediction->mean += Extrapolated(query, y.rows());
  SetDeviations(options, prediction);
}

void LocalRegression::Weigh(const Eigen::MatrixXd& x, const Eigen::VectorXd& query,
                            Eigen::Index dofs, const LocalRegressionOptions& options) {
  x_ = x.colwise() - query;
  if (options.velocity_scale > 0.0)
    for (Eigen::Index row = x_.rows() - dofs; row > 0; row -= dofs) {
      auto pose = x_.middleRows(row, dofs);
      pose = options.velocity_scale * (x_.middleRows(row - dofs, dofs) - pose);
    }
  if (options.row_scales.size() > 0) x_.array().colwise() *= options.row_scales.array();
  root_weights_ = x_.colwise().squaredNorm();
  const double nearest = root_weights_.minCoeff();
  const double bandwidth =
      options.bandwidth * (options.relative_bandwidth ? std::sqrt(root_weights_.maxCoeff()) : 1.0);
  // A factor common to all weights does not matter: the nearest has 1, however far
  // it is. All at the query: all equal.
  if (bandwidth > 0.0)
    for (double& weight : root_weights_) {  // Eq. (7)
      const double distance = std::sqrt(weight - nearest) / bandwidth;
      weight = std::max(std::exp(-0.5 * distance * distance), kLeastWeight);
    }
  else
    root_weights_.setOnes();
  root_weights_ = (root_weights_ / root_weights_.sum()).cwiseSqrt();
}

// With s = sqrt(omega), |s| = 1, a column of weighted data times s is its mean. A
// reflection of s to the first unit vector takes the mean out of the other K - 1.
void LocalRegression::Centre(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y,
                             RegressionTarget target) {
  y_ = y;
  if (target == RegressionTarget::kChange) y_ -= LastPose(x, y.rows());
  if (target == RegressionTarget::kAcceleration) y_ -= Extrapolated(x, y.rows());
  x_.array().rowwise() *= root_weights_.transpose().array();
  y_.array().rowwise() *= root_weights_.transpose().array();

  reflector_.resize(root_weights_.size() - 1);
  root_weights_.makeHouseholder(reflector_, reflector_scale_, reflected_mean_);
  scratch_.resize(std::max({x_.rows(), y_.rows(), x_.cols()}));
  x_.applyHouseholderOnTheRight(reflector_, reflector_scale_, scratch_.data());
  y_.applyHouseholderOnTheRight(reflector_, reflector_scale_, scratch_.data());
}

void LocalRegression::Decompose() {
  const Eigen::Index count = x_.cols() - 1;
  directions_.resize(count + 1, count);
  eigenvalues_.resize(count);
  query_.resize(count);
  targets_.resize(y_.rows(), count);
  if (count == 0) return;
  const auto inputs = x_.rightCols(count);
  gram_.setZero(count, count);
  gram_.selfadjointView<Eigen::Lower>().rankUpdate(inputs.transpose());
  eigen_.compute(gram_);
  eigenvalues_ = eigen_.eigenvalues().cwiseMax(0.0);
  const Eigen::MatrixXd& eigenvectors = eigen_.eigenvectors();
  directions_.row(0).setZero();
  directions_.bottomRows(count) = eigenvectors;
  directions_.applyHouseholderOnTheLeft(reflector_, reflector_scale_, scratch_.data());
  targets_.noalias() = y_.rightCols(count) * eigenvectors;
  // x_ is about the query, so the query about the mean is minus the mean.
  used_.noalias() = inputs.transpose() * x_.col(0);
  query_.noalias() = eigenvectors.transpose() * used_;
  query_ *= -reflected_mean_;
}

double LocalRegression::ChooseRidge() {
  const double largest = eigenvalues_.size() > 0 ? eigenvalues_.maxCoeff() : 0.0;
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  for (const double share : kRidges) {
    const double squares = UseRidge(share * largest);
    if (squares < least) {
      least = squares;
      best = share * largest;
    }
  }
  UseRidge(best);
  return best;
}

int LocalRegression::ChooseLeading(const LocalRegressionOptions& options) {
  const auto limit = std::min<Eigen::Index>(options.max_components, eigenvalues_.size());
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int count = 0; count <= limit; ++count) {
    const double squares = UseLeading(count);
    if (squares < least) {
      least = squares;
      best = count;
    }
  }
  return best;
}

double LocalRegression::UseRidge(double ridge) {
  used_.resize(eigenvalues_.size());
  left_.resize(eigenvalues_.size());
  for (Eigen::Index i = 0; i < used_.size(); ++i) {
    const double sum = eigenvalues_[i] + ridge;
    left_[i] = sum > 0.0 ? ridge / sum : 1.0;
    used_[i] = sum > 0.0 ? eigenvalues_[i] / sum : 0.0;
  }
  return LeaveOneOut();
}

double LocalRegression::UseLeading(int count) {
  const Eigen::Index size = eigenvalues_.size();
  const double noise = size > 0 ? kSingular * eigenvalues_[size - 1] : 0.0;
  used_.resize(size);
  left_.resize(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const bool is_used = i >= size - count && eigenvalues_[i] > noise;
    used_[i] = is_used ? 1.0 : 0.0;
    // Where all are used nothing is left, neither of the residuals nor of what they
    // are divided by; their ratio has the limit of a ridge that goes to 0.
    left_[i] = is_used ? noise / (eigenvalues_[i] + noise) : 1.0;
  }
  return LeaveOneOut();
}

// The residual at a neighbour of the model without it is its residual over
// 1 - H_kk, H the hat matrix. Exact for given ridge (Allen 1974).
double LocalRegression::LeaveOneOut() {
  targets_left_ = targets_ * left_.asDiagonal();
  residuals_.noalias() = targets_left_ * directions_.transpose();
  leverage_left_.noalias() = directions_.cwiseAbs2() * left_;
  leverage_left_ = leverage_left_.cwiseMax(std::numeric_limits<double>::min());
  residuals_.array().rowwise() /= leverage_left_.transpose().array();
  return residuals_.squaredNorm();
}

void LocalRegression::PredictByDirections(LocalPrediction* prediction) {
  for (Eigen::Index i = 0; i < used_.size(); ++i)
    if (used_[i] > 0.0)
      prediction->mean += used_[i] / eigenvalues_[i] * query_[i] * targets_.col(i);
  prediction->effective_dofs = 1.0 + used_.sum();
  prediction->num_components = static_cast<int>((used_.array() == 1.0).count());
}

void LocalRegression::SolvePartialLeastSquares(const LocalRegressionOptions& options,
                                               LocalPrediction* prediction) {
  const auto size = static_cast<int>(eigenvalues_.size());
  int count = std::min(options.num_components, size);
  if (options.num_components == 0) {
    // Half of what would explain anything.
    FitPartialLeastSquares(std::min(options.max_components, size / 2), prediction);
    loo_squares_.minCoeff(&count);
  }
  FitPartialLeastSquares(count, prediction);
  prediction->num_components = count;
  prediction->effective_dofs = 1.0 + count;
}

void LocalRegression::FitPartialLeastSquares(int count, LocalPrediction* prediction) {
  scores_.resize(eigenvalues_.size(), count);
  score_at_query_.resize(count);
  loading_.resize(count);
  loo_squares_.setZero(count + 1);
  residuals_.resize(y_.rows(), x_.cols());
  prediction->mean = reflected_mean_ * y_.col(0);
  for (Eigen::Index output = 0; output < y_.rows(); ++output) {
    FindScores(output);
    scores_at_neighbours_.noalias() = directions_ * scores_;
    output_left_.noalias() = directions_ * targets_.row(output).transpose();
    leverage_left_ = 1.0 - root_weights_.array().square();
    for (int j = 0;; ++j) {
      residuals_.row(output) =
          output_left_.cwiseQuotient(leverage_left_.cwiseMax(kLeastLeverageLeft));
      loo_squares_[j] += residuals_.row(output).squaredNorm();
      if (j == count) break;
      output_left_ -= loading_[j] * scores_at_neighbours_.col(j);
      leverage_left_ -= scores_at_neighbours_.col(j).cwiseAbs2();
      prediction->mean[output] += loading_[j] * score_at_query_[j];
    }
  }
}

// Kernel PLS of one output (Rosipal and Trejo 2001) where the Gram matrix is
// diagonal: the next score is the Gram matrix times what is left of the output,
// made orthogonal to the scores before. The query goes along as one more row.
void LocalRegression::FindScores(Eigen::Index output) {
  scores_.setZero();
  score_at_query_.setZero();
  loading_.setZero();
  target_left_ = targets_.row(output).transpose();
  const double explained = kSingular * target_left_.norm();
  for (Eigen::Index j = 0; j < scores_.cols() && target_left_.norm() > explained; ++j) {
    score_ = eigenvalues_.cwiseProduct(target_left_);
    double at_query = query_.dot(target_left_);
    const double length_before = score_.norm();
    for (int pass = 0; pass < 2; ++pass)  // twice is enough (Kahan, Parlett)
      for (Eigen::Index i = 0; i < j; ++i) {
        const double product = scores_.col(i).dot(score_);
        score_ -= product * scores_.col(i);
        at_query -= product * score_at_query_[i];
      }
    const double length = score_.norm();
    if (!(length > kSingular * length_before)) return;
    scores_.col(j) = score_ / length;
    score_at_query_[j] = at_query / length;
    loading_[j] = scores_.col(j).dot(target_left_);
    target_left_ -= loading_[j] * scores_.col(j);
  }
}

void LocalRegression::SetDeviations(const LocalRegressionOptions& options,
                                    LocalPrediction* prediction) {
  prediction->stddev = residuals_.rowwise().norm().cwiseMax(options.least_stddev);
  if (!options.whitening) {
    prediction->whitening.resize(0, 0);
    return;
  }
  covariance_.noalias() = (1.0 - options.shrinkage) * residuals_ * residuals_.transpose();
  covariance_.diagonal() = prediction->stddev.cwiseAbs2();
  cholesky_.compute(covariance_);
  prediction->whitening.setIdentity(covariance_.rows(), covariance_.cols());
  cholesky_.matrixL().solveInPlace(prediction->whitening);
}

}  // namespace poselift
