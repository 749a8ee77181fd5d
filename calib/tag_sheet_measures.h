// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

#include "calib/tag_family.h"

namespace poselift {

// The measures that laying out and drawing of tag sheets share.
inline constexpr double kMargin_m = 0.010;     // that printers do not reach
inline constexpr double kFooter_m = 0.034;     // the ruler, what size means
inline constexpr double kPad_m = 0.003;        // from the print to the cut line
inline constexpr double kArrowRoom_m = 0.008;  // above the print
inline constexpr double kTextRoom_m = 0.013;   // below it

// The edge of all that belongs to a tag, white border included.
inline double PrintEdge_m(const TagFamily& family, double size_m) {
  return size_m * family.cells() / family.cells_of_size();
}

// What is cut out: at least as wide as its text.
inline Eigen::Vector2d BlockSize_m(const TagFamily& family, double size_m) {
  const double print_m = PrintEdge_m(family, size_m);
  return {print_m + 2.0 * kPad_m, print_m + kArrowRoom_m + kTextRoom_m};
}

}  // namespace poselift
