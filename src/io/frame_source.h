// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace poselift {

struct VideoFrame {
  int index = 0;        // from 0
  double time_s = 0.0;  // when it is to be shown, as the source says; grows from frame to frame
  cv::Mat bgr;          // 8 bits, upright
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
};

}  // namespace poselift
