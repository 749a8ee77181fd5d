// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/camera_choice.h"

#include <charconv>

#include "src/capture/fourcc.h"
#include "src/capture/frame_decoder.h"
#include "src/input_error.h"

namespace poselift {

cv::Size ParseSize(const std::string& text) {
  cv::Size size_px;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size_px.width);
  const bool has_cross = width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X');
  const auto height = std::from_chars(has_cross ? width.ptr + 1 : end, end, size_px.height);
  if (height.ec != std::errc() || height.ptr != end || size_px.width < 1 || size_px.height < 1)
    throw InputError("found the size " + text + ", wanted WIDTHxHEIGHT in pixels: 1280x720");
  return size_px;
}

uint32_t ParseFormat(const std::string& text) {
  const std::string letters = text + "    ";
  const uint32_t fourcc = Fourcc(letters[0], letters[1], letters[2], letters[3]);
  if (text.size() > 4 || !IsDecodable(fourcc))
    throw InputError("found the format " + text + ", wanted " + DecodableFormats());
  return fourcc;
}

CameraOptions CameraChoice::Options() const {
  CameraOptions options;
  options.wanted = {format.empty() ? 0 : ParseFormat(format), ParseSize(size), rate_hz};
  for (const std::string& control : controls) options.controls.push_back(ParseControl(control));
  return options;
}

}  // namespace poselift
