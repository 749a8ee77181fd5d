// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/trail.h"

#include <algorithm>

namespace poselift {

std::vector<TrailPoint> TrailOf(const Labels& labels, PersonRef ref, std::string_view landmark) {
  std::vector<TrailPoint> trail;
  const FrameLabels& here = labels.frames.at(ref.frame);
  if (!here.frame && !here.time_s) return trail;
  const int at = static_cast<int>(ref.frame);
  const int last = std::min(static_cast<int>(labels.frames.size()) - 1, at + TrailPoint::kMostAway);
  for (int f = std::max(0, at - TrailPoint::kMostAway); f <= last; ++f) {
    const auto frame = static_cast<size_t>(f);
    if (here.frame && labels.frames[frame].image != here.image) continue;  // of another video
    const LandmarkLabel* const label = FindLandmark(labels, {frame, ref.id}, landmark);
    if (label && label->state != LabelState::kAbsent) trail.push_back({f - at, label->x_px});
  }
  return trail;
}

}  // namespace poselift
