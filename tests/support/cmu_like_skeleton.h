// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string_view>

#include "src/skeleton.h"

namespace poselift::testing {

// A made-up skeleton built as the CMU files build theirs: 31 bones with their
// names, axes, dofs, rest pose (legs spread by 20 degrees, arms level, palms
// down) and limits, in metres and radians. x is the subject's left, y up, z
// forward. Exactly mirror-symmetric, standing about 1.75 m tall.
Skeleton CmuLikeSkeleton();

// TrimToJoints of it: 23 bones, 40 dofs and the root.
Skeleton TrimmedCmuLikeSkeleton();

// The mirrored pose of a mirror-symmetric CMU skeleton: left and right change
// places, and so do the signs of what turns about y and z.
SkeletonPose MirroredPose(const Skeleton& skeleton, const SkeletonPose& pose);

// The dof of a bone in pose->dofs, e.g. DofOf(skeleton, "ltibia", Dof::Kind::kRx, &pose) = 0.5.
double& DofOf(const Skeleton& skeleton, std::string_view bone, Dof::Kind kind, SkeletonPose* pose);

}  // namespace poselift::testing
