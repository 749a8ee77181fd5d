// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/pose_prior.h"

#include <Eigen/Eigenvalues>

namespace poselift {

PosePrior LearnPosePrior(const Eigen::MatrixXd& poses_m, double eps_m) {
  PosePrior prior;
  prior.mean_m = poses_m.rowwise().mean();
  const auto count = static_cast<double>(poses_m.cols());
  const Eigen::MatrixXd covariance =
      poses_m * poses_m.transpose() / count - prior.mean_m * prior.mean_m.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  const Eigen::VectorXd inverse_sigma =
      (eigen.eigenvalues().cwiseMax(0.0).array() + eps_m * eps_m).rsqrt();
  prior.whitening = inverse_sigma.asDiagonal() * eigen.eigenvectors().transpose();
  return prior;
}

}  // namespace poselift
