// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "src/capture/frame_decoder.h"
#include "src/io/frame_ring.h"
#include "src/io/frame_source.h"
#include "src/io/jpeg_frame.h"
#include "src/io/video_recorder.h"

namespace poselift {

// The raw video of a camera, as its frames come: from the start or, with before_s, from so
// long before Start.
class TrackVideo {
 public:
  // Throws InputError when the file cannot be written.
  TrackVideo(const std::filesystem::path& path, const RawFormat& format,
             std::optional<double> before_s);

  // frame: with its encoded bytes; a damaged one is left out. Throws as VideoRecorder::Add.
  void Add(const VideoFrame& frame);
  // Somebody is seen: what the ring holds goes into the file, and all that follows.
  void Start();
  void Close() { recorder_.Close(); }

 private:
  JpegEncoder encoder_;
  VideoRecorder recorder_;
  std::optional<FrameRing> ring_;  // until Start
};

}  // namespace poselift
