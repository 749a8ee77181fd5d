// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstddef>
#include <vector>

namespace ceres {
class CostFunction;
class Manifold;
}  // namespace ceres

namespace poselift::testing {

// The analytic Jacobian of block b along its tangent against central differences. The
// block is put back.
void ExpectJacobianAgrees(const ceres::CostFunction& cost, const std::vector<double*>& blocks,
                          size_t b, const ceres::Manifold& manifold);

}  // namespace poselift::testing
