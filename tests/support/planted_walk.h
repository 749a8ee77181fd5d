// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "src/motion.h"

namespace poselift::testing {

// A walk with known contacts, on TrimmedCmuLikeSkeleton at 60 Hz: a stride of 60
// frames and 1.2 m along z, each foot flat on the floor for `stance` of it and in
// between through the air; the left foot's stance begins at frame 0, the right
// one's half a stride later.
struct PlantedWalk {
  Motion motion;
  std::vector<bool> left;  // whether the foot stands
  std::vector<bool> right;
};

PlantedWalk PlantWalk(int num_frames, double stance, double floor_height_m);

}  // namespace poselift::testing
