// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <vector>

#include "lift/ik/articulation.h"
#include "lift/ik/pose_costs.h"

namespace ceres {
class CostFunction;
}

namespace poselift {

// MakeReprojectionCost with the lengths of the bones as further unknowns: behind
// its parameter blocks comes one of kNumBoneGroups log ratios (body_proportions.h)
// to the lengths of `standard`, whose bones end at the 23 joints.
std::unique_ptr<ceres::CostFunction> MakeProportionsCost(const Articulation& standard,
                                                         std::vector<TargetPoint> points);

}  // namespace poselift
