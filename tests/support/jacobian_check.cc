// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/jacobian_check.h"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <Eigen/Core>

#include "tests/support/support.h"

namespace poselift::testing {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void ExpectJacobianAgrees(const ceres::CostFunction& cost, const std::vector<double*>& blocks,
                          size_t b, const ceres::Manifold& manifold) {
  const int size = manifold.AmbientSize();
  RowMajorMatrix by_block(cost.num_residuals(), size);
  std::vector<double*> jacobians(blocks.size(), nullptr);
  jacobians[b] = by_block.data();
  Eigen::VectorXd residuals(cost.num_residuals());
  cost.Evaluate(blocks.data(), residuals.data(), jacobians.data());
  const Eigen::VectorXd start = Eigen::Map<Eigen::VectorXd>(blocks[b], size);
  RowMajorMatrix by_tangent(size, manifold.TangentSize());
  manifold.PlusJacobian(start.data(), by_tangent.data());

  constexpr double kStep = 1e-6;
  Eigen::MatrixXd numeric(cost.num_residuals(), manifold.TangentSize());
  for (int k = 0; k < manifold.TangentSize(); ++k) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(manifold.TangentSize());
    Eigen::VectorXd behind(cost.num_residuals());
    step[k] = kStep;
    manifold.Plus(start.data(), step.data(), blocks[b]);
    cost.Evaluate(blocks.data(), residuals.data(), nullptr);
    step[k] = -kStep;
    manifold.Plus(start.data(), step.data(), blocks[b]);
    cost.Evaluate(blocks.data(), behind.data(), nullptr);
    numeric.col(k) = (residuals - behind) / (2 * kStep);
  }
  Eigen::Map<Eigen::VectorXd>(blocks[b], size) = start;
  EXPECT_TRUE(MatrixNear(by_block * by_tangent, numeric, 1e-6)) << "block " << b;
}

}  // namespace poselift::testing
