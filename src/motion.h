// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "src/skeleton.h"

namespace poselift {

// A skeleton moving at a fixed rate.
struct Motion {
  Skeleton skeleton;
  double frame_time_s = 1.0 / 120.0;
  std::vector<SkeletonPose> frames;
};

}  // namespace poselift
