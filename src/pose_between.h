// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "src/skeleton.h"

namespace poselift {

// The linear mixture of two poses of a skeleton, part 0 is a and 1 is b: of the root's
// rotation by slerp, of an angle the short way round.
SkeletonPose PoseBetween(const Skeleton& skeleton, const SkeletonPose& a, const SkeletonPose& b,
                         double part);

}  // namespace poselift
