// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "src/labels.h"
#include "ui/label/label_edits.h"

namespace poselift {

// Where a landmark goes in the frames of a video around one.
struct TrailPoint {
  static constexpr int kMostAway = 15;  // frames, in both directions

  int away = 0;  // < 0: before
  Eigen::Vector2d x_px;
};

// In order. Where the landmark is absent, or has no label, a point is missing. Empty where the
// frames are of no video: pictures of their own have no way through them.
std::vector<TrailPoint> TrailOf(const Labels& labels, PersonRef ref, std::string_view landmark);

}  // namespace poselift
