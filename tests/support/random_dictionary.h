// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <random>

#include "lift/dictionary.h"

namespace poselift::testing {

// A made-up body of about 1.7 m in a T pose: the 23 bones of the paper under
// their CMU names, 40 joint dofs with limits, axes that are not parallel to the
// world, left and right exact mirror images (x is the subject's left, y up).
Skeleton SmallSkeleton();

// Atoms whose numbers are independent Gaussians, scaled to unit norm, but for
// the pelvis at the origin; SmallSkeleton(); no prior; nothing was trained.
// typical_norm_m is that of the T pose.
Dictionary RandomDictionary(int num_atoms, std::mt19937_64* rng);

}  // namespace poselift::testing
