// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <random>

#include "src/skeleton.h"

namespace poselift::testing {

// Any rotation and a position within 2 m; each dof uniform in the given part
// of its range of limits about zero (rotations without limits within 1 rad,
// shifts without within 0.1 m).
SkeletonPose RandomPoseWithinLimits(const Skeleton& skeleton, double part, std::mt19937_64* rng);

// Uniform over all rotations.
Eigen::Quaterniond RandomRotation(std::mt19937_64* rng);

}  // namespace poselift::testing
