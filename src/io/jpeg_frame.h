// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/capture/frame_decoder.h"

namespace poselift {

// A frame of a camera as a JPEG picture.
struct JpegFrame {
  double time_s = 0.0;  // when it was taken, of a clock that only goes forwards
  std::vector<uint8_t> bytes;
};

// Makes JPEG pictures that any program opens of a camera's frames.
//
// MJPG stays as it came, but for three things that webcams leave to the reader:
// the standard Huffman tables (ITU T.81, K.3) are put in where there are none, what
// stands behind the end is dropped, and an end is put where there is none.
//
// Other formats are compressed at that quality, YUYV and NV12 without a detour over
// RGB. Cameras give Y from 16 to 235 (ITU BT.601), JPEG has 0 to 255: it is stretched,
// so that the picture has the colours that cv::cvtColor makes of the frame.
class JpegEncoder {
 public:
  // quality: 1 to 100, of what is compressed here.
  // Throws std::invalid_argument: not a decodable format, no size, an odd one where pixels
  // share a colour, lines shorter than a row, no such quality.
  explicit JpegEncoder(const RawFormat& format, int quality = 90);

  // False, and no bytes, for a frame that is damaged: shorter than its size wants; MJPG
  // whose head is not whole or states another size. Its picture data is not looked at.
  bool Encode(std::span<const uint8_t> frame, std::vector<uint8_t>* jpeg);

 private:
  void FillPlanes(const uint8_t* frame);
  bool Compress(std::vector<uint8_t>* jpeg);

  bool IsRaw() const;

  RawFormat format_;
  int quality_;
  size_t wanted_bytes_ = 0;  // of a raw frame
  std::unique_ptr<void, int (*)(void*)> turbo_;
  std::vector<uint8_t> planes_[3];
  std::vector<uint8_t> compressed_;
};

}  // namespace poselift
