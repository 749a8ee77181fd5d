// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>

#include "src/io/frame_source.h"

namespace poselift {

// A video as a camera would show it: no frame before its time, and none that is late by
// more than a frame's time; those are counted as lost. The last frame comes however late it
// is, so that all are counted. Clocks are CLOCK_MONOTONIC.
class PacedFrameSource : public FrameSource {
 public:
  explicit PacedFrameSource(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  cv::Size size_px() const override { return source_->size_px(); }
  std::optional<VideoFrame> Next() override;
  std::optional<double> Skip_s() override { return source_->Skip_s(); }
  void Stop() override;

 private:
  bool WaitUntil(double time_s);

  std::unique_ptr<FrameSource> source_;
  double start_s_ = -1.0;  // of the clock, at time 0
  double last_s_ = 0.0;    // of the frame before

  std::mutex mutex_;  // guards stop_
  std::condition_variable stopped_;
  bool stop_ = false;
};

}  // namespace poselift
