// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <random>

#include "lift/temporal/motion_codebook.h"
#include "tests/support/support.h"

namespace poselift::testing {

// Numbers that are independent Gaussians, of SmallSkeleton(), with a training record;
// without a generator the running test's own.
MotionCodebook RandomCodebook(int num_segments, std::mt19937_64 rng = TestRng());

}  // namespace poselift::testing
