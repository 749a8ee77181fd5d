// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "src/observation.h"
#include "src/skeleton.h"

namespace poselift::testing {

// A tag beside and turned to a bone, seen exactly where the pose has it.
ObservedBonePose PlantTag(const Skeleton& skeleton, const SkeletonPose& pose,
                          const std::string& bone);

}  // namespace poselift::testing
