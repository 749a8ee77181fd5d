// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

#include "src/pose3.h"
#include "src/skeleton.h"

namespace poselift {

// L of Algorithm 1: the length of the bone that ends at each joint, metres; 0
// for the pelvis. The skeleton must have all 23 joints.
Eigen::VectorXd BoneLengths(const Skeleton& skeleton);

// Pose normalisation (Algorithm 1 of the sparse coding paper, corrected: see
// lift/README.md): along the five chains, from the pelvis outwards, every bone
// keeps its direction and gets its standard length. The pelvis stays. A bone
// of no length has no direction: it takes that of the bone before it in its
// chain, +y at the start of one.
//
// pose: 3 x 23 in any unit and frame; the result is in metres.
Pose3 NormalizePose(const Pose3& pose, const Eigen::VectorXd& bone_lengths_m);

}  // namespace poselift
