// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <utility>
#include <vector>

#include "src/skeleton.h"

namespace poselift {

// A skeleton with what is looked up once: finding it by name takes longer than
// a solve.
struct Articulation {
  explicit Articulation(Skeleton skeleton_in)
      : skeleton(std::move(skeleton_in)),
        sites(FindJointSites(skeleton)),
        dof_starts(skeleton.DofStarts()),
        num_dofs(skeleton.NumDofs()) {}

  Skeleton skeleton;
  JointSites sites;             // where the 23 joints sit
  std::vector<int> dof_starts;  // of each bone
  int num_dofs;
};

}  // namespace poselift
