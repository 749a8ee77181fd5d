// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/playback.h"

#include <algorithm>

namespace poselift {
namespace {

constexpr double kStep_s = 1.0 / 30.0;

}  // namespace

Playback::Playback(const Labels& labels, size_t from) : from_(from), since_s_{0.0} {
  const auto& frames = labels.frames;
  for (size_t f = from + 1; f < frames.size(); ++f) {
    const auto before_s = frames[f - 1].time_s, now_s = frames[f].time_s;
    const bool grows = before_s && now_s && *now_s > *before_s;
    since_s_.push_back(since_s_.back() + (grows ? *now_s - *before_s : kStep_s));
  }
}

Playback::Playback(size_t num_frames, double frame_time_s, size_t from)
    : from_(from), since_s_{0.0} {
  for (size_t f = from + 1; f < num_frames; ++f)
    since_s_.push_back(static_cast<double>(f - from) * frame_time_s);
}

size_t Playback::FrameAt(double elapsed_s) const {
  const auto after = std::ranges::upper_bound(since_s_, elapsed_s);
  const auto count = after - since_s_.begin();
  return from_ + static_cast<size_t>(std::max<std::ptrdiff_t>(count - 1, 0));
}

}  // namespace poselift
