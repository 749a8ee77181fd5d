// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/scaled_gplvm.h"

#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "src/input_error.h"

namespace poselift {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Where training starts. A signal to noise of three, as the leading components
// leave some of the variance.
constexpr double kFirstAlpha = 1.0, kFirstBeta = 10.0, kFirstGamma = 1.0;
constexpr int kLbfgsRank = 20;
constexpr double kTolerance = 1e-7;

// The parameters by name.
struct Parameters {
  Parameters(const VectorXd& all, Index latent_dim, Index num_poses)
      : latent(all.head(latent_dim * num_poses).reshaped(latent_dim, num_poses)),
        alpha(std::exp(all[latent.size()])),
        beta(std::exp(all[latent.size() + 1])),
        gamma(std::exp(all[latent.size() + 2])),
        scales(all.tail(all.size() - latent.size() - 3).array().exp()) {}

  MatrixXd latent;
  double alpha, beta, gamma;
  VectorXd scales;
};

MatrixXd SquaredDistances(const MatrixXd& x) {
  const VectorXd squares = x.colwise().squaredNorm().transpose();
  MatrixXd distances = -2.0 * x.transpose() * x;
  distances.colwise() += squares;
  distances.rowwise() += squares.transpose();
  return distances.cwiseMax(0.0);
}

class TrainingCost final : public ceres::FirstOrderFunction {
 public:
  TrainingCost(const MatrixXd& y, const ScaledGplvmOptions& options, int num_parameters)
      : y_(y), options_(options), num_parameters_(num_parameters) {}

  int NumParameters() const override { return num_parameters_; }

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    parameters_ = Eigen::Map<const VectorXd>(parameters, num_parameters_);
    if (!ScaledGplvmCost(y_, options_.latent_dim, options_.least_stddev, parameters_, cost,
                         gradient ? &gradient_ : nullptr))
      return false;
    if (gradient) Eigen::Map<VectorXd>(gradient, num_parameters_) = gradient_;
    return true;
  }

 private:
  const MatrixXd& y_;
  ScaledGplvmOptions options_;
  int num_parameters_;
  mutable VectorXd parameters_, gradient_;
};

// Principal components of the rows over their standard deviations, each of
// variance 1, and those deviations' inverse as scales.
VectorXd FirstParameters(const MatrixXd& y, const ScaledGplvmOptions& options) {
  const auto count = static_cast<double>(y.cols());
  const VectorXd scales =
      (y.rowwise().squaredNorm() / count).cwiseSqrt().cwiseMax(options.least_stddev).cwiseInverse();
  const MatrixXd scaled = scales.asDiagonal() * y;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled * scaled.transpose() / count);
  const Index q = options.latent_dim;
  const VectorXd stddevs = eigen.eigenvalues().tail(q).cwiseMax(1e-12).cwiseSqrt();
  const MatrixXd latent =
      stddevs.cwiseInverse().asDiagonal() * eigen.eigenvectors().rightCols(q).transpose() * scaled;
  VectorXd parameters(latent.size() + 3 + y.rows());
  parameters << latent.reshaped(), std::log(kFirstAlpha), std::log(kFirstBeta),
      std::log(kFirstGamma), scales.array().log().matrix();
  return parameters;
}

MatrixXd Covariance(const Parameters& p) {
  MatrixXd K = p.alpha * (-0.5 * p.gamma * SquaredDistances(p.latent)).array().exp();
  K.diagonal().array() += 1.0 / p.beta;
  return K;
}

void RequireFit(const MatrixXd& y, const ScaledGplvmOptions& options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  if (y.cols() <= options.latent_dim || y.rows() < options.latent_dim)
    throw InputError(fmt::format(
        "GPLVM: {} poses of {} features, wanted more poses and no fewer features than the {} "
        "latent dimensions",
        y.cols(), y.rows(), options.latent_dim));
  if (!y.allFinite()) throw InputError("GPLVM: a feature is not finite");
}

}  // namespace

std::string ScaledGplvmOptions::Validate() const {
  if (latent_dim < 1)
    return fmt::format("ScaledGplvmOptions::latent_dim = {}, wanted at least 1", latent_dim);
  if (max_iterations < 1)
    return fmt::format("ScaledGplvmOptions::max_iterations = {}, wanted at least 1",
                       max_iterations);
  if (!(least_stddev > 0.0 && std::isfinite(least_stddev)))
    return fmt::format("ScaledGplvmOptions::least_stddev = {}, wanted > 0", least_stddev);
  return "";
}

bool ScaledGplvmCost(const MatrixXd& y, int latent_dim, double least_stddev,
                     const VectorXd& parameters, double* cost, VectorXd* gradient) {
  const Index num_poses = y.cols(), dim = y.rows();
  const auto n = static_cast<double>(num_poses), d = static_cast<double>(dim);
  const Parameters p(parameters, latent_dim, num_poses);
  const MatrixXd squared_distances = SquaredDistances(p.latent);
  const MatrixXd rbf = p.alpha * (-0.5 * p.gamma * squared_distances).array().exp();
  MatrixXd K = rbf;
  K.diagonal().array() += 1.0 / p.beta;
  const Eigen::LLT<MatrixXd> cholesky(K);
  if (cholesky.info() != Eigen::Success) return false;

  const MatrixXd scaled = y.transpose() * p.scales.asDiagonal();  // N x D
  const MatrixXd solved = cholesky.solve(scaled);
  const VectorXd fits = scaled.cwiseProduct(solved).colwise().sum().transpose() +
                        n * least_stddev * least_stddev * p.scales.cwiseAbs2();
  const double log_det = 2.0 * MatrixXd(cholesky.matrixLLT()).diagonal().array().log().sum();
  *cost = 0.5 * d * log_det - n * p.scales.array().log().sum() + 0.5 * fits.sum() +
          0.5 * p.latent.squaredNorm() + std::log(p.alpha * p.beta * p.gamma);
  if (!std::isfinite(*cost)) return false;
  if (!gradient) return true;

  // d cost / dK
  MatrixXd by_K = 0.5 * d * cholesky.solve(MatrixXd::Identity(num_poses, num_poses));
  by_K.noalias() -= 0.5 * solved * solved.transpose();
  const MatrixXd by_rbf = by_K.cwiseProduct(rbf);
  const VectorXd sums = by_rbf.rowwise().sum();
  gradient->resize(parameters.size());
  gradient->head(p.latent.size()).reshaped(latent_dim, num_poses) =
      p.latent - 2.0 * p.gamma * (p.latent * sums.asDiagonal() - p.latent * by_rbf);
  const Index scalars = p.latent.size();
  (*gradient)[scalars] = sums.sum() + 1.0;
  (*gradient)[scalars + 1] = 1.0 - by_K.trace() / p.beta;
  (*gradient)[scalars + 2] = 1.0 - 0.5 * p.gamma * by_rbf.cwiseProduct(squared_distances).sum();
  gradient->tail(dim) = fits.array() - n;
  return true;
}

ScaledGplvm TrainScaledGplvm(const MatrixXd& y, const ScaledGplvmOptions& options) {
  RequireFit(y, options);
  ScaledGplvm model;
  model.mean = y.rowwise().mean();
  const MatrixXd centred = y.colwise() - model.mean;
  VectorXd parameters = FirstParameters(centred, options);
  const ceres::GradientProblem problem(
      new TrainingCost(centred, options, static_cast<int>(parameters.size())));
  ceres::GradientProblemSolver::Options solver;
  solver.line_search_direction_type = ceres::LBFGS;
  solver.max_lbfgs_rank = kLbfgsRank;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = kTolerance;
  solver.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(solver, problem, parameters.data(), &summary);

  const Parameters p(parameters, options.latent_dim, y.cols());
  model.alpha = p.alpha;
  model.beta = p.beta;
  model.gamma = p.gamma;
  model.scales = p.scales;
  model.latent = p.latent;
  model.inverse = Eigen::LLT<MatrixXd>(Covariance(p)).solve(MatrixXd::Identity(y.cols(), y.cols()));
  model.coefficients = centred * model.inverse;
  model.cost = summary.final_cost;
  model.iterations = static_cast<int>(summary.iterations.size()) - 1;
  return model;
}

void Predict(const ScaledGplvm& model, const VectorXd& x, GplvmPrediction* prediction) {
  GplvmPrediction& p = *prediction;
  p.to_latent = model.latent.colwise() - x;
  p.kernel = model.alpha *
             (-0.5 * model.gamma * p.to_latent.colwise().squaredNorm().transpose()).array().exp();
  p.kernel_by_x = model.gamma * (p.kernel.asDiagonal() * p.to_latent.transpose());
  p.solved.noalias() = model.inverse * p.kernel;
  p.mean = model.mean;
  p.mean.noalias() += model.coefficients * p.kernel;
  p.mean_by_x.noalias() = model.coefficients * p.kernel_by_x;
  p.variance = std::max(model.alpha - p.kernel.dot(p.solved), 0.0) + 1.0 / model.beta;
  p.variance_by_x = -2.0 * p.kernel_by_x.transpose() * p.solved;
}

}  // namespace poselift
