// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <iterator>
#include <vector>

namespace poselift {

// The frames first, ..., last of a sequence.
struct FrameSpan {
  int first = 0;
  int last = 0;

  int NumFrames() const { return last - first + 1; }
  bool operator==(const FrameSpan&) const = default;
};

// The runs of frames that are true.
inline std::vector<FrameSpan> SpansOf(const std::vector<bool>& frames) {
  std::vector<FrameSpan> spans;
  for (int t = 0; t < std::ssize(frames); ++t) {
    if (!frames[t]) continue;
    if (t == 0 || !frames[t - 1]) spans.push_back({t, t});
    spans.back().last = t;
  }
  return spans;
}

}  // namespace poselift
