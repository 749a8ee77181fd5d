// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "src/capture/camera_controls.h"
#include "src/capture/camera_formats.h"
#include "src/capture/system_calls.h"

namespace poselift::testing {

// A buffer as a driver fills it.
struct FakeBuffer {
  std::string bytes;
  uint32_t sequence = 0;
  uint32_t flags = 0;    // V4L2_BUF_FLAG_..., beside the clock's
  double time_s = -1.0;  // the driver's time; below 0: the present
  bool on_monotonic_clock = true;
};

// A camera that answers the system calls of capture as V4L2 has it, without a device. What it
// is and what goes wrong is set before it is opened. Its clock stands still but for what poll
// waits and for a frame's time, so tests do not wait. Several threads may use it.
class FakeCamera : public SystemCalls {
 public:
  std::string path = "/dev/video0";
  std::string name = "Fake Camera";
  uint32_t device_caps = 0;  // 0: one that streams
  std::vector<CameraFormat> formats;
  std::vector<CameraControl> controls;  // their values change; menus as they are
  double frame_time_s = 1.0 / 30.0;
  // What the driver makes of what it is asked for.
  std::function<CameraMode(CameraMode)> give = [](CameraMode asked) { return asked; };
  int bytes_per_line = 0;
  // The frame of that number; what is not set is filled in: the sequence.
  std::function<FakeBuffer(int)> frame;
  int num_frames = 1 << 30;  // then it is silent
  // Errors by the request, for all times, or from a number of frames on.
  int open_error = 0;
  std::map<unsigned long, int> errors;
  std::map<int, int> errors_at_frame;  // of DQBUF
  bool unplugged_at_end = false;       // ENODEV, not silence

  // How many frames may come; all unless it was called.
  void Allow(int num_frames);
  // The same, and waits until they were taken and the next one is polled for.
  void AllowAndWait(int num_frames);

  int num_open() const { return num_open_; }
  int num_mapped() const { return num_mapped_; }
  int num_streaming() const { return streaming_ ? 1 : 0; }
  CameraMode mode() const { return mode_; }
  const CameraControl& control(const std::string& control_name) const;
  // Names of the controls in the order in which they were set.
  const std::vector<std::string>& set_controls() const { return set_controls_; }

  int Open(const std::string& opened) override;
  void Close(int fd) override;
  int Ioctl(int fd, unsigned long request, void* argument) override;
  int Map(int fd, size_t num_bytes, int64_t offset, void** memory) override;
  void Unmap(void* memory, size_t num_bytes) override;
  bool Poll(int fd, int timeout_ms) override;
  double Now_s() override;

 private:
  int Answer(unsigned long request, void* argument);
  int DescribeSelf(void* argument) const;
  int EnumerateFormat(void* argument) const;
  int EnumerateSize(void* argument) const;
  int EnumerateInterval(void* argument) const;
  int Format(void* argument, bool is_set);
  int Rate(void* argument, bool is_set);
  int RequestBuffers(void* argument);
  int TakeFrame(void* argument);
  int QueryControl(void* argument) const;
  int QueryMenu(void* argument) const;
  int ControlValueOf(void* argument, bool is_set);

  mutable std::mutex mutex_;
  std::condition_variable allowed_changed_;
  int num_allowed_ = 1 << 30;
  int polled_at_ = -1;  // the frame that poll waits for
  double now_s_ = 1000.0;
  CameraMode mode_;
  std::vector<std::string> memory_;
  std::deque<uint32_t> queued_;
  int next_frame_ = 0;
  int num_open_ = 0;
  int num_mapped_ = 0;
  bool streaming_ = false;
  std::vector<std::string> set_controls_;
};

// A picture in the formats of a camera: a ramp of grey, from left (dark) to right.
cv::Mat GreyRamp(cv::Size size_px);
std::string AsYuyv(const cv::Mat& grey, int bytes_per_line = 0);
std::string AsNv12(const cv::Mat& grey, int bytes_per_line = 0);
std::string AsJpeg(const cv::Mat& picture, int restart_interval = 0);
// Without its Huffman tables, as many webcams send it.
std::string WithoutHuffmanTables(const std::string& jpeg);

// A webcam: YUYV that gets slow with size, MJPG that does not, and the usual controls.
void MakeWebcam(FakeCamera* camera);

}  // namespace poselift::testing
