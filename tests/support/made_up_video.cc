// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/made_up_video.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

namespace poselift::testing {
namespace {

std::string BigEndian(uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

uint32_t ReadBigEndian(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// The boxes with the body of the one at the end of the path changed.
std::string Changed(const std::string& boxes, const std::vector<std::string>& path,
                    const std::function<std::string(std::string)>& change) {
  std::string changed;
  for (size_t at = 0; at + 8 <= boxes.size();) {
    const size_t size = ReadBigEndian(boxes, at);
    if (size < 8 || at + size > boxes.size()) break;
    const std::string type = boxes.substr(at + 4, 4);
    std::string body = boxes.substr(at + 8, size - 8);
    if (type == path.front())
      body =
          path.size() == 1 ? change(body) : Changed(body, {path.begin() + 1, path.end()}, change);
    changed += BigEndian(static_cast<uint32_t>(body.size() + 8)) + type + body;
    at += size;
  }
  return changed;
}

}  // namespace

cv::Mat Texture(cv::Size size_px, std::mt19937_64* rng) {
  cv::Mat sum = cv::Mat::zeros(size_px, CV_32FC1);
  for (double sigma_px = 1.5; sigma_px < 30.0; sigma_px *= 2.0) {
    cv::Mat noise(size_px, CV_32FC1);
    std::normal_distribution<float> normal;
    for (float& value : cv::Mat_<float>(noise)) value = normal(*rng);
    cv::GaussianBlur(noise, noise, {}, sigma_px);
    sum += noise * (25.0 * sigma_px);
  }
  cv::Mat grey, bgr;
  sum.convertTo(grey, CV_8U, 1.0, 128.0);
  cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

void WriteVideo(const std::filesystem::path& path, const std::vector<cv::Mat>& frames,
                double rate_hz) {
  const int codec = path.extension() == ".avi" ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G')
                                               : cv::VideoWriter::fourcc('m', 'p', '4', 'v');
  cv::VideoWriter writer(path.string(), cv::CAP_FFMPEG, codec, rate_hz, frames.front().size());
  ASSERT_TRUE(writer.isOpened());
  for (const cv::Mat& frame : frames) writer.write(frame);
}

std::string WithFrameDurations(const std::string& mp4, const std::vector<double>& durations) {
  return Changed(mp4, {"moov", "trak", "mdia", "minf", "stbl", "stts"}, [&](std::string body) {
    const uint32_t even = ReadBigEndian(body, 12);  // behind version, count, count of the first
    std::string table = body.substr(0, 4) + BigEndian(static_cast<uint32_t>(durations.size()));
    for (const double duration : durations)
      table += BigEndian(1) + BigEndian(static_cast<uint32_t>(std::lround(duration * even)));
    return table;
  });
}

std::string TurnedClockwise(const std::string& mp4) {
  return Changed(mp4, {"moov", "trak", "tkhd"}, [&](std::string body) {
    std::string matrix;
    for (const uint32_t value :
         {0x0U, 0x10000U, 0x0U, 0xFFFF0000U, 0x0U, 0x0U, 0x0U, 0x0U, 0x40000000U})
      matrix += BigEndian(value);
    return body.replace(40, matrix.size(), matrix);
  });
}

std::optional<VideoFrame> PaintedVideo::Next() {
  if (next_ == times_s_.size()) return std::nullopt;
  VideoFrame frame{static_cast<int>(next_), times_s_[next_], paint_(times_s_[next_])};
  ++next_;
  return frame;
}

std::optional<double> PaintedVideo::Skip_s() {
  if (next_ == times_s_.size()) return std::nullopt;
  return times_s_[next_++];
}

}  // namespace poselift::testing
