// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/track_video.h"

#include <span>
#include <utility>

namespace poselift {

TrackVideo::TrackVideo(const std::filesystem::path& path, const RawFormat& format,
                       std::optional<double> before_s)
    : encoder_(format), recorder_(path, format.size_px) {
  if (before_s) ring_.emplace(FrameRing::Options{.length_s = *before_s});
}

void TrackVideo::Add(const VideoFrame& frame) {
  JpegFrame jpeg{frame.monotonic_s, {}};
  if (!encoder_.Encode(std::span(frame.encoded.data, frame.encoded.total()), &jpeg.bytes)) return;
  if (ring_)
    ring_->Push(std::move(jpeg));
  else
    recorder_.Add(jpeg);
}

void TrackVideo::Start() {
  if (!ring_) return;
  ring_->FlushInto(&recorder_);
  ring_.reset();
}

}  // namespace poselift
