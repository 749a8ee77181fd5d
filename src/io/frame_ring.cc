// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/frame_ring.h"

#include <utility>

#include "src/io/video_recorder.h"

namespace poselift {

void FrameRing::Push(JpegFrame frame) {
  if (!frames_.empty() && frame.time_s < frames_.back().time_s) {
    frames_.clear();
    num_bytes_ = 0;
  }
  num_bytes_ += frame.bytes.size();
  frames_.push_back(std::move(frame));
  const double oldest_s = frames_.back().time_s - options_.length_s;
  while (!frames_.empty() && (num_bytes_ > options_.max_bytes || frames_.front().time_s < oldest_s))
    PopOldest();
}

void FrameRing::PopOldest() {
  num_bytes_ -= frames_.front().bytes.size();
  frames_.pop_front();
}

void FrameRing::FlushInto(VideoRecorder* recorder) {
  while (!frames_.empty()) {
    recorder->Add(frames_.front());
    PopOldest();
  }
}

}  // namespace poselift
