// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "src/capture/camera_stream.h"

namespace poselift {

// What a user says of the camera's mode and controls, as typed.
struct CameraChoice {
  std::string size = "1280x720";
  double rate_hz = 30.0;
  std::string format;                 // empty: whichever is best
  std::vector<std::string> controls;  // "exposure=50"

  // Throws InputError for text that is none of it.
  CameraOptions Options() const;
};

// "1280x720" and "MJPG". Throw InputError.
cv::Size ParseSize(const std::string& text);
uint32_t ParseFormat(const std::string& text);

}  // namespace poselift
