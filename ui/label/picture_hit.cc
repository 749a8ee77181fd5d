// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/picture_hit.h"

namespace poselift {

std::optional<PictureHit> HitLandmark(const FrameLabels& frame, const Eigen::Vector2d& x_px,
                                      double radius_px, size_t preferred_person) {
  std::optional<PictureHit> best;
  double best_px = radius_px;
  for (size_t p = 0; p < frame.people.size(); ++p) {
    const std::vector<LandmarkLabel>& landmarks = frame.people[p].landmarks;
    for (size_t l = 0; l < landmarks.size(); ++l) {
      if (landmarks[l].state == LabelState::kAbsent) continue;
      const double distance_px = (landmarks[l].x_px - x_px).norm();
      const bool is_better =
          distance_px < best_px || (distance_px == best_px && (!best || p == preferred_person));
      if (!(distance_px <= best_px) || !is_better) continue;
      best = PictureHit{p, l};
      best_px = distance_px;
    }
  }
  return best;
}

}  // namespace poselift
