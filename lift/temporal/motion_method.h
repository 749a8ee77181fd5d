// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "lift/ik/pose_costs.h"
#include "src/skeleton.h"

namespace poselift {

// A way to recover a moving body from a few observed points, frame after frame.
class MotionMethod {
 public:
  virtual ~MotionMethod() = default;
  // The first poses, the oldest first: what the method looks back on.
  virtual void Begin(const std::vector<SkeletonPose>& first) = 0;
  // observed: points of the body and where they are in world, weighted by
  // 1 / sigma^2. The pose is on the skeleton that the method was made for.
  virtual SkeletonPose Next(const std::vector<TargetPoint>& observed) = 0;
};

}  // namespace poselift
