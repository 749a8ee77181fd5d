// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "src/motion.h"
#include "src/skeleton.h"

namespace poselift::testing {

// A made-up skeleton as animators rig theirs, unlike CMU's in all that can be
// unlike: a root that stays at the origin and carries hips that shift, names with
// a prefix, four bones of spine, one of neck, clavicles that turn, two fingers a
// hand, a T-pose, orders and axes of dofs, z up and y to the back. In metres times
// `unit`.
Skeleton RigSkeleton(double unit = 1.0);

// Where on it, in the rig's world, a motion of the trimmed CMU-like skeleton has
// the limbs and the pelvis; the fingers curl in waves.
Motion OnRig(const Motion& walk, double unit = 1.0);

}  // namespace poselift::testing
