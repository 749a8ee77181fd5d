// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace ceres {
class CostFunction;
}

namespace poselift {

// root_weights o (sum_b coefficients_b p_b - target), over parameter blocks p_b of
// one size: a change for {-1, 1}, a second difference for {1, -2, 1}, a value for
// {1}. target and root_weights have the size of a block.
std::unique_ptr<ceres::CostFunction> MakeDifferenceCost(std::vector<double> coefficients,
                                                        Eigen::VectorXd target,
                                                        Eigen::VectorXd root_weights);

}  // namespace poselift
