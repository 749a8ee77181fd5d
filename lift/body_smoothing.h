// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "lift/smooth_motion.h"
#include "src/skeleton.h"

namespace poselift {

// Whether the bones and their dofs are the same; lengths may differ.
bool IsSameBody(const Skeleton& a, const Skeleton& b);

// A smoother of motions on one skeleton of 23 joints, `body`, as one of motions on
// any skeleton that is a body: there and back by BodyTransfer. What the body knows
// nothing of (fingers, dofs that it lacks) is as `rest` smooths it. Calling it
// throws InputError for a skeleton that is no body (FindBody).
MotionSmoother SmootherOfBody(Skeleton body, MotionSmoother of_body, MotionSmoother rest);

}  // namespace poselift
