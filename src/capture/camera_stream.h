// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/capture/camera_controls.h"
#include "src/capture/camera_formats.h"
#include "src/capture/frame_decoder.h"
#include "src/capture/v4l2_device.h"

namespace poselift {

struct CameraOptions {
  CameraMode wanted{0, {1280, 720}, 30.0};
  std::vector<ControlValue> controls;  // set before the stream starts, in this order
  int num_buffers = 4;                 // the driver's, from 2 to 32

  std::string Validate() const;
};

// A frame as the driver gave it.
struct CameraFrame {
  cv::Mat bytes;             // CV_8U, one row; a copy
  uint32_t sequence = 0;     // the driver's count, lost ones included
  int num_lost = 0;          // right before this one: missing in that count, or broken
  double monotonic_s = 0.0;  // CLOCK_MONOTONIC when it was taken
};

// Frames that did not come, so far.
struct CaptureCounts {
  int64_t given = 0;
  int64_t lost = 0;     // missing in the driver's count
  int64_t bad = 0;      // marked as broken by the driver, empty, or not to be decoded
  int64_t dropped = 0;  // as nobody fetched them in time

  int64_t num_missing() const { return lost + bad + dropped; }
};

// A camera that streams, by V4L2 with memory shared with the driver.
//
// The constructor chooses a mode (ChooseMode), asks for it and reads back what the driver
// gave, which may be another: given(). Where a program writes into the device
// (v4l2loopback), its format is taken as it is. Times are the driver's where it has them
// on the monotonic clock and they are near the present, else those of arrival; they grow.
//
// Throws InputError, here and from Read, for what V4l2Device says, a busy device, no
// room on the bus, an unplugged camera, or a driver without a format that can be decoded.
class CameraStream {
 public:
  CameraStream(const std::string& path, const CameraOptions& options,
               SystemCalls* system = RealSystem());
  ~CameraStream();
  CameraStream(const CameraStream&) = delete;
  CameraStream& operator=(const CameraStream&) = delete;

  // The next frame, or nothing when none came within that time.
  std::optional<CameraFrame> Read(double timeout_s);

  const V4l2Device& device() const { return device_; }
  const std::vector<CameraFormat>& formats() const { return formats_; }
  const CameraMode& asked() const { return asked_; }
  const CameraMode& given() const { return given_; }
  const RawFormat& format() const { return format_; }
  const std::vector<ControlSetting>& controls() const { return controls_; }
  const CaptureCounts& counts() const { return counts_; }

 private:
  struct Buffer {
    void* memory = nullptr;
    size_t num_bytes = 0;
  };

  void Negotiate(const CameraMode& wanted);
  void NegotiateRate();
  void ShareBuffers(int count);
  void Start();
  void Release();
  std::optional<CameraFrame> TakeBuffer();
  double TimeOf(double driver_s, bool is_monotonic);

  V4l2Device device_;
  std::vector<CameraFormat> formats_;
  CameraMode asked_, given_;
  RawFormat format_;
  std::vector<ControlSetting> controls_;
  std::vector<Buffer> buffers_;
  CaptureCounts counts_;
  std::optional<uint32_t> last_sequence_;
  int num_lost_ = 0;    // since the last frame given
  int num_errors_ = 0;  // one after the other
  double last_s_ = 0.0;
};

}  // namespace poselift
