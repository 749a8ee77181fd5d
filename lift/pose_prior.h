// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

namespace poselift {

// How common a pose y (69 numbers, body frame, metres) is, whatever its code:
//
//   |whitening (y - mean)|^2 = (y - mean)^T (Sigma + eps^2 I)^-1 (y - mean)
//
// The sparse code alone leaves the depth of a 2D lift to whichever atoms happen
// to suit the picture; these rows, put under those of the projection operator,
// hold what no label sees to what bodies do.
struct PosePrior {
  Eigen::VectorXd mean_m;     // 69
  Eigen::MatrixXd whitening;  // 69 x 69, 1/m

  bool Empty() const { return mean_m.size() == 0; }
};

// Mean and covariance of the columns of poses (69 x m), eps in metres.
PosePrior LearnPosePrior(const Eigen::MatrixXd& poses_m, double eps_m = 0.015);

}  // namespace poselift
