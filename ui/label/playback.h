// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstddef>
#include <vector>

#include "src/labels.h"

namespace poselift {

// Frames as they follow each other in real time, evenly or by their times; from one without a time,
// or with one that does not grow, 1/30 s passes. Who asks seldom misses frames, and never lags.
class Playback {
 public:
  Playback(const Labels& labels, size_t from);
  Playback(size_t num_frames, double frame_time_s, size_t from);

  // Which frame is to be seen so long after the start; the last one at the end and beyond it.
  size_t FrameAt(double elapsed_s) const;
  bool IsOver(double elapsed_s) const { return elapsed_s >= since_s_.back(); }

 private:
  size_t from_;
  std::vector<double> since_s_;  // the start, of each frame from the first that is played
};

}  // namespace poselift
