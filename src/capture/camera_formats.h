// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "src/capture/v4l2_device.h"

namespace poselift {

// What a camera is asked for, and what it gives.
struct CameraMode {
  uint32_t fourcc = 0;   // 0: whichever is best
  cv::Size size_px;      // pixels
  double rate_hz = 0.0;  // 0: not known

  bool operator==(const CameraMode&) const = default;
};

// "1280x720 MJPG 30 Hz".
std::string ModeText(const CameraMode& mode);

struct CameraSize {
  cv::Size size_px;
  std::vector<double> rates_hz;  // highest first; empty where the driver does not say
};

struct CameraFormat {
  uint32_t fourcc = 0;
  std::string description;        // by the driver: "Motion-JPEG"
  std::vector<CameraSize> sizes;  // largest first
  // Of a camera that offers any size between two: the usual ones stand in sizes.
  bool any_size = false;
  cv::Size smallest_px, largest_px;
};

// All that the driver offers, also what cannot be decoded. Where any size is offered,
// also_px is listed with the usual ones. Rates that lie anywhere in a range are
// listed as its ends and the usual ones between.
std::vector<CameraFormat> ListFormats(const V4l2Device& device, cv::Size also_px = {});

// The mode of those offered that comes nearest to the wanted one: the wanted size, or the
// nearest; then the wanted rate, or the highest; then what costs least: grey, planes of Y
// and UV, YUYV, JPEG. So MJPG is taken where YUYV would cap the rate. A fourcc that
// is wanted is kept. Only formats that can be decoded (see frame_decoder.h); fourcc 0
// where there is none.
CameraMode ChooseMode(const std::vector<CameraFormat>& formats, const CameraMode& wanted);

}  // namespace poselift
