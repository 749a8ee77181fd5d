// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

namespace poselift {

// How the bytes of a camera's frame are to be read.
struct RawFormat {
  uint32_t fourcc = 0;     // see fourcc.h
  cv::Size size_px;        // YUYV: even width; NV12: even width and height
  int bytes_per_line = 0;  // of its first plane, padding included; 0: none. Not of a JPEG
};

// MJPG (and JPEG, the same), YUYV, NV12 and GREY.
bool IsDecodable(uint32_t fourcc);
// "MJPG, YUYV, NV12 or GREY".
std::string DecodableFormats();

// Frames of a camera to pictures. Whatever the bytes are, the picture is whole or refused:
// short ones, JPEG of another size, cut short or damaged as far as JPEG, which has no
// checksum, lets it be seen. JPEG without Huffman tables, as webcams send it, has the usual
// ones; a few bytes too many before a marker, as many webcams send them, are no damage.
//
// A decoder is used by one thread at a time.
class FrameDecoder {
 public:
  FrameDecoder();

  // bytes: CV_8U, one row, as the driver gave them. What is wrong with them, or nothing.
  // Grey is the camera's Y: black may be 16 and white 235. Of NV12 and GREY it shares
  // the memory of the bytes.
  std::string ToGrey(const RawFormat& format, const cv::Mat& bytes, cv::Mat* grey);
  std::string ToBgr(const RawFormat& format, const cv::Mat& bytes, cv::Mat* bgr);

 private:
  std::string DecodeJpeg(const RawFormat& format, const cv::Mat& bytes, int type, cv::Mat* picture);
  std::string TryJpeg(const RawFormat& format, const cv::Mat& bytes, int type, cv::Mat* picture);

  std::unique_ptr<void, int (*)(void*)> jpeg_;
};

}  // namespace poselift
