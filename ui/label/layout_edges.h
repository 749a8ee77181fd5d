// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <utility>
#include <vector>

#include "src/layout.h"

namespace poselift {

// Which landmarks of a layout a line joins, by their numbers: each that stands for one joint and
// the nearest joint before it, towards the pelvis, that the layout has too. A landmark between two
// hips or shoulders counts as the joint whose name it has.
std::vector<std::pair<int, int>> LayoutEdges(const Layout& layout);

}  // namespace poselift
