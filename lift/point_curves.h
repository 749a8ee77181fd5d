// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "src/observation.h"

namespace poselift {

// The 2D points of a body over time, each coordinate a curve: gaps of at most
// max_gap_frames are filled by straight lines, then a zero-lag Butterworth
// low-pass takes noise off. Gaps between frames, not those at the ends. Filled
// points are marked occluded, with twice their curve's mean sigma. 3D points,
// and the pinhole, stay as they are. cutoff_hz 0, or one that the frame rate does
// not allow: gaps are filled, nothing is smoothed.
std::vector<Observation> SmoothPoints(const std::vector<Observation>& frames, double frame_time_s,
                                      double cutoff_hz, int max_gap_frames);

// The points that are seen in any frame, by name, in the order of appearance.
std::vector<ObservedPoint> PointsOf(const std::vector<Observation>& frames);

}  // namespace poselift
