// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>

namespace poselift {

// The scaled Gaussian process latent variable model of K. Grochow, S. L. Martin,
// A. Hertzmann, Z. Popovic, Style-Based Inverse Kinematics (2004): N poses y_i of D
// features are smooth functions of latent points x_i of few dimensions,
//
//   k(x, x') = alpha exp(-gamma/2 |x - x'|^2) + [x is x'] / beta
//
// each feature with a scale w_d of its own. All of it is found together,
//
//   min over x_i, alpha, beta, gamma, w
//     D/2 ln|K| - N sum_d ln w_d + 1/2 sum_d w_d^2 (Y_d^T K^-1 Y_d + N least_stddev^2)
//     + 1/2 sum_i |x_i|^2 + ln(alpha beta gamma)
//
// Y_d being row d without its mean. least_stddev is ours: without it the scale of
// a feature that does not vary would grow for ever.
struct ScaledGplvmOptions {
  int latent_dim = 3;
  int max_iterations = 100;
  double least_stddev = 1e-2;  // in the unit of the features

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct ScaledGplvm {
  double alpha = 1.0, beta = 1.0, gamma = 1.0;
  Eigen::VectorXd scales;        // w, D
  Eigen::VectorXd mean;          // D
  Eigen::MatrixXd latent;        // Q x N: the x_i
  Eigen::MatrixXd inverse;       // N x N: K^-1
  Eigen::MatrixXd coefficients;  // D x N: Y K^-1
  double cost = 0.0;             // what was minimised
  int iterations = 0;
};

// What the model says of the pose at x: feature d has
//   f_d(x) = mean_d + Y_d^T K^-1 k(x)   and variance   sigma^2(x) / w_d^2,
//   sigma^2(x) = alpha + 1 / beta - k(x)^T K^-1 k(x) >= 1 / beta
struct GplvmPrediction {
  Eigen::VectorXd mean;           // D
  double variance = 0.0;          // sigma^2
  Eigen::MatrixXd mean_by_x;      // D x Q
  Eigen::VectorXd variance_by_x;  // Q

  Eigen::VectorXd kernel, solved;  // storage
  Eigen::MatrixXd to_latent, kernel_by_x;
};

// y: D x N, N > latent_dim, finite. By L-BFGS from the leading principal
// components; an iteration costs O(N^3 + N^2 D). The same input gives the same
// bytes. Throws InputError when the options are invalid or do not fit y.
ScaledGplvm TrainScaledGplvm(const Eigen::MatrixXd& y, const ScaledGplvmOptions& options = {});

// Reuses the storage of *prediction.
void Predict(const ScaledGplvm& model, const Eigen::VectorXd& x, GplvmPrediction* prediction);

// What training minimises, for those who want to look at it. parameters: the x_i,
// ln alpha, ln beta, ln gamma, ln w_d; gradient: as many, or null. y: D x N without
// its mean. False where K is not positive definite in numbers.
bool ScaledGplvmCost(const Eigen::MatrixXd& y, int latent_dim, double least_stddev,
                     const Eigen::VectorXd& parameters, double* cost, Eigen::VectorXd* gradient);

}  // namespace poselift
