// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "lift/temporal/motion_codebook.h"

namespace poselift::testing {

// Numbers that are independent Gaussians, of SmallSkeleton(), with a training record;
// the running test's own.
MotionCodebook RandomCodebook(int num_segments);

}  // namespace poselift::testing
