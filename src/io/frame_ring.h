// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstddef>
#include <deque>

#include "src/io/jpeg_frame.h"

namespace poselift {

class VideoRecorder;

// The last seconds of a camera, for a recording that starts before its button is pressed.
class FrameRing {
 public:
  struct Options {
    double length_s = 5.0;
    size_t max_bytes = 256u << 20;  // of pictures; the oldest go first
  };

  explicit FrameRing(const Options& options) : options_(options) {}

  // A frame that is older than the last one starts the ring anew: the clock was set back.
  void Push(JpegFrame frame);

  // Moves all frames, oldest first, to the end of the recording. Throws as VideoRecorder::Add.
  void FlushInto(VideoRecorder* recorder);

  size_t num_frames() const { return frames_.size(); }
  size_t num_bytes() const { return num_bytes_; }

 private:
  void PopOldest();

  Options options_;
  std::deque<JpegFrame> frames_;
  size_t num_bytes_ = 0;
};

}  // namespace poselift
