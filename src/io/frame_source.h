// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace poselift {

// Which pictures of a frame are wanted: finding tags needs no colours, and JPEG is decoded
// in half the time without them.
enum class Pictures { kBgr, kGrey, kBoth };

struct VideoFrame {
  int index = 0;        // from 0
  double time_s = 0.0;  // when it is to be shown, as the source says; grows from frame to frame
  cv::Mat bgr;          // 8 bits, upright; empty where only grey was asked for
  cv::Mat grey;         // 8 bits, upright; empty unless asked for

  // Of cameras.
  int num_lost = 0;  // frames lost right before this one
  // CLOCK_MONOTONIC when it was taken; NaN of files.
  double monotonic_s = std::numeric_limits<double>::quiet_NaN();
  // The frame as the camera gave it, where it was asked to be kept: CV_8U, one row.
  cv::Mat encoded;
  uint32_t fourcc = 0;  // V4L2's name of its format: see src/capture/fourcc.h
};

// Pictures one after the other, all of one size: a video file; anything else
// that gives pictures with times.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual cv::Size size_px() const = 0;
  // Nothing at the end. Throws InputError where the source is broken.
  virtual std::optional<VideoFrame> Next() = 0;
  // Goes past the next frame, at less cost; its time, or nothing at the end.
  virtual std::optional<double> Skip_s() = 0;
  // Of those that wait for their frames: any thread may call it, and soon Next gives nothing.
  virtual void Stop() {}
};

}  // namespace poselift
