// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/detection_tally.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace poselift::testing {
namespace {

bool IsVisible(const TagTruth& tag) {
  return tag.visible_share > 0.99 && tag.facing_rad < std::numbers::pi / 3;
}

}  // namespace

void DetectionTally::Add(const FrameTruth& truth, const std::vector<TagDetection>& detections) {
  constexpr double kNear_px = 3.0;
  for (const TagTruth& tag : truth.tags) visible += IsVisible(tag) ? 1 : 0;
  for (const TagDetection& seen : detections) {
    const auto tag = std::find_if(truth.tags.begin(), truth.tags.end(),
                                  [&](const TagTruth& of) { return of.id == seen.id; });
    const bool is_worn = tag != truth.tags.end();
    const auto errors_px = is_worn ? (seen.corners_px - tag->corners_px).colwise().norm().eval()
                                   : Eigen::RowVector4d();
    if (!is_worn || !(errors_px.minCoeff() < kNear_px)) {
      ++wrong;
    } else if (IsVisible(*tag)) {
      ++found;
      corners += 4;
      square_px2 += errors_px.squaredNorm();
    }
  }
}

double DetectionTally::Share() const { return static_cast<double>(found) / visible; }
double DetectionTally::CornerRms_px() const { return std::sqrt(square_px2 / corners); }

}  // namespace poselift::testing
