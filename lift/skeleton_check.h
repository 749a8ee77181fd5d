// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "src/skeleton.h"

namespace poselift {

// Beyond any body, metres.
inline constexpr double kLargestLength_m = 10.0;

// What the standard skeleton of a learned model may not be, in one line, or ""
// when all is well: the 23 bones under the names and in the order and the tree of
// Joints(), no more than 10 m long, axis frames that are rotations, at most six
// dofs a bone and none of the root, limits in order.
std::string SkeletonFlaw(const Skeleton& skeleton);

// Whether no number is larger in size; false for NaN.
template <typename Derived>
bool AllWithin(const Eigen::MatrixBase<Derived>& matrix, double largest) {
  return (matrix.array().abs() <= largest).all();
}

}  // namespace poselift
