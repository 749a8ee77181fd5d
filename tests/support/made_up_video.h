// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <vector>

#include "src/io/frame_source.h"

namespace poselift::testing {

// Random texture with detail at every scale from 3 px up: what flow can hold on to.
cv::Mat Texture(cv::Size size_px, std::mt19937_64* rng);

// Writes the pictures at an even rate, by the ending of the name: .avi (Motion
// JPEG) or .mp4 (MPEG-4).
void WriteVideo(const std::filesystem::path& path, const std::vector<cv::Mat>& frames,
                double rate_hz);

// The MP4 file with other durations of its frames, in units of the even one;
// their sum must be their number.
std::string WithFrameDurations(const std::string& mp4, const std::vector<double>& durations);

// The MP4 file, to be shown turned clockwise by a quarter.
std::string TurnedClockwise(const std::string& mp4);

// Frames as a function of time paint them.
class PaintedVideo : public FrameSource {
 public:
  PaintedVideo(std::vector<double> times_s, std::function<cv::Mat(double time_s)> paint)
      : times_s_(std::move(times_s)), paint_(std::move(paint)) {}
  cv::Size size_px() const override { return paint_(times_s_.front()).size(); }
  std::optional<VideoFrame> Next() override;
  std::optional<double> Skip_s() override;
  size_t num_read() const { return next_; }

 private:
  std::vector<double> times_s_;
  std::function<cv::Mat(double)> paint_;
  size_t next_ = 0;
};

}  // namespace poselift::testing
