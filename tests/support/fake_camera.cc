// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/fake_camera.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "src/capture/fourcc.h"

namespace poselift::testing {
namespace {

constexpr int kFd = 4711;

// Into a field of that size, which is zero.
void Write(const std::string& text, void* field, size_t size) {
  std::memcpy(field, text.data(), std::min(text.size(), size - 1));
}

v4l2_fract Interval(double rate_hz) {
  return {1000, static_cast<uint32_t>(std::lround(1000.0 * rate_hz))};
}

}  // namespace

void FakeCamera::Allow(int count) {
  const std::lock_guard lock(mutex_);
  num_allowed_ = count;
  allowed_changed_.notify_all();
}

void FakeCamera::AllowAndWait(int count) {
  std::unique_lock lock(mutex_);
  num_allowed_ = count;
  allowed_changed_.notify_all();
  allowed_changed_.wait(lock, [&] { return polled_at_ >= count; });
}

const CameraControl& FakeCamera::control(const std::string& control_name) const {
  return *std::find_if(controls.begin(), controls.end(),
                       [&](const CameraControl& c) { return c.name == control_name; });
}

int FakeCamera::Open(const std::string& opened) {
  const std::lock_guard lock(mutex_);
  if (opened != path) return -ENOENT;
  if (open_error) return -open_error;
  ++num_open_;
  return kFd;
}

void FakeCamera::Close(int fd) {
  const std::lock_guard lock(mutex_);
  num_open_ -= fd == kFd ? 1 : 100;
  streaming_ = false;
}

int FakeCamera::Map(int fd, size_t num_bytes, int64_t offset, void** memory) {
  const std::lock_guard lock(mutex_);
  if (const auto error = errors.find(0); error != errors.end()) return error->second;
  const auto index = static_cast<size_t>(offset);
  if (fd != kFd || index >= memory_.size() || num_bytes != memory_[index].size()) return EINVAL;
  *memory = memory_[index].data();
  ++num_mapped_;
  return 0;
}

void FakeCamera::Unmap(void* /*memory*/, size_t /*num_bytes*/) {
  const std::lock_guard lock(mutex_);
  --num_mapped_;
}

bool FakeCamera::Poll(int fd, int timeout_ms) {
  std::unique_lock lock(mutex_);
  if (fd != kFd) return false;
  const bool ends = unplugged_at_end && next_frame_ >= num_frames;
  if (ends || errors.count(VIDIOC_DQBUF)) return true;
  // Silence of the camera takes the clock's time, and none of the test's.
  if (next_frame_ >= num_frames) {
    now_s_ += timeout_ms / 1000.0;
    return false;
  }
  polled_at_ = next_frame_;
  allowed_changed_.notify_all();
  return allowed_changed_.wait_for(lock, std::chrono::milliseconds(timeout_ms),
                                   [&] { return next_frame_ < num_allowed_; });
}

double FakeCamera::Now_s() {
  const std::lock_guard lock(mutex_);
  return now_s_;
}

int FakeCamera::Ioctl(int fd, unsigned long request, void* argument) {
  const std::lock_guard lock(mutex_);
  if (fd != kFd) return EBADF;
  if (const auto error = errors.find(request); error != errors.end()) return error->second;
  return Answer(request, argument);
}

int FakeCamera::Answer(unsigned long request, void* argument) {
  switch (request) {
    case VIDIOC_QUERYCAP:
      return DescribeSelf(argument);
    case VIDIOC_ENUM_FMT:
      return EnumerateFormat(argument);
    case VIDIOC_ENUM_FRAMESIZES:
      return EnumerateSize(argument);
    case VIDIOC_ENUM_FRAMEINTERVALS:
      return EnumerateInterval(argument);
    case VIDIOC_G_FMT:
    case VIDIOC_S_FMT:
      return Format(argument, request == VIDIOC_S_FMT);
    case VIDIOC_G_PARM:
    case VIDIOC_S_PARM:
      return Rate(argument, request == VIDIOC_S_PARM);
    case VIDIOC_REQBUFS:
      return RequestBuffers(argument);
    case VIDIOC_QUERYBUF: {
      auto* buffer = static_cast<v4l2_buffer*>(argument);
      buffer->length = static_cast<uint32_t>(memory_.at(buffer->index).size());
      buffer->m.offset = buffer->index;
      return 0;
    }
    case VIDIOC_QBUF:
      queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
      return 0;
    case VIDIOC_DQBUF:
      return TakeFrame(argument);
    case VIDIOC_STREAMON:
    case VIDIOC_STREAMOFF:
      streaming_ = request == VIDIOC_STREAMON;
      return 0;
    case VIDIOC_QUERY_EXT_CTRL:
      return QueryControl(argument);
    case VIDIOC_QUERYMENU:
      return QueryMenu(argument);
    case VIDIOC_G_CTRL:
    case VIDIOC_S_CTRL:
      return ControlValueOf(argument, request == VIDIOC_S_CTRL);
    default:
      return ENOTTY;
  }
}

int FakeCamera::DescribeSelf(void* argument) const {
  auto* capability = static_cast<v4l2_capability*>(argument);
  Write("fake", capability->driver, sizeof(capability->driver));
  Write(name, capability->card, sizeof(capability->card));
  Write("usb-0000:00:14.0-1", capability->bus_info, sizeof(capability->bus_info));
  capability->device_caps = device_caps ? device_caps : V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  // Of all nodes of the device: more than this one can.
  capability->capabilities =
      V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_META_CAPTURE | V4L2_CAP_DEVICE_CAPS;
  return 0;
}

int FakeCamera::EnumerateFormat(void* argument) const {
  auto* entry = static_cast<v4l2_fmtdesc*>(argument);
  if (entry->index >= formats.size()) return EINVAL;
  entry->pixelformat = formats[entry->index].fourcc;
  Write(formats[entry->index].description, entry->description, sizeof(entry->description));
  return 0;
}

int FakeCamera::EnumerateSize(void* argument) const {
  auto* entry = static_cast<v4l2_frmsizeenum*>(argument);
  for (const CameraFormat& format : formats) {
    if (format.fourcc != entry->pixel_format) continue;
    if (format.any_size) {
      if (entry->index > 0) return EINVAL;
      entry->type = V4L2_FRMSIZE_TYPE_STEPWISE;
      entry->stepwise = {static_cast<uint32_t>(format.smallest_px.width),
                         static_cast<uint32_t>(format.largest_px.width),
                         2,
                         static_cast<uint32_t>(format.smallest_px.height),
                         static_cast<uint32_t>(format.largest_px.height),
                         2};
      return 0;
    }
    if (entry->index >= format.sizes.size()) return EINVAL;
    entry->type = V4L2_FRMSIZE_TYPE_DISCRETE;
    const cv::Size size_px = format.sizes[entry->index].size_px;
    entry->discrete = {static_cast<uint32_t>(size_px.width), static_cast<uint32_t>(size_px.height)};
    return 0;
  }
  return EINVAL;
}

int FakeCamera::EnumerateInterval(void* argument) const {
  auto* entry = static_cast<v4l2_frmivalenum*>(argument);
  for (const CameraFormat& format : formats) {
    if (format.fourcc != entry->pixel_format) continue;
    if (format.any_size) {
      if (entry->index > 0) return EINVAL;
      entry->type = V4L2_FRMIVAL_TYPE_CONTINUOUS;
      entry->stepwise = {Interval(60.0), Interval(2.0), {1, 1}};
      return 0;
    }
    for (const CameraSize& size : format.sizes) {
      if (size.size_px.width != static_cast<int>(entry->width) ||
          size.size_px.height != static_cast<int>(entry->height))
        continue;
      if (entry->index >= size.rates_hz.size()) return EINVAL;
      entry->type = V4L2_FRMIVAL_TYPE_DISCRETE;
      entry->discrete = Interval(size.rates_hz[entry->index]);
      return 0;
    }
  }
  return EINVAL;
}

int FakeCamera::Format(void* argument, bool is_set) {
  auto* format = static_cast<v4l2_format*>(argument);
  v4l2_pix_format& pix = format->fmt.pix;
  if (mode_.fourcc == 0) mode_ = give({kFourccYuyv, {640, 480}, 30.0});
  if (is_set) {
    const cv::Size size_px(static_cast<int>(pix.width), static_cast<int>(pix.height));
    mode_ = give({pix.pixelformat, size_px, mode_.rate_hz});
  }
  pix.pixelformat = mode_.fourcc;
  pix.width = static_cast<uint32_t>(mode_.size_px.width);
  pix.height = static_cast<uint32_t>(mode_.size_px.height);
  pix.bytesperline = static_cast<uint32_t>(bytes_per_line);
  pix.sizeimage = pix.width * pix.height * 2;
  return 0;
}

int FakeCamera::Rate(void* argument, bool is_set) {
  auto* parameters = static_cast<v4l2_streamparm*>(argument);
  v4l2_captureparm& capture = parameters->parm.capture;
  if (is_set) {
    CameraMode asked = mode_;
    asked.rate_hz = static_cast<double>(capture.timeperframe.denominator) /
                    static_cast<double>(capture.timeperframe.numerator);
    mode_ = give(asked);
  }
  capture.capability = V4L2_CAP_TIMEPERFRAME;
  capture.timeperframe = Interval(mode_.rate_hz);
  return 0;
}

int FakeCamera::RequestBuffers(void* argument) {
  auto* request = static_cast<v4l2_requestbuffers*>(argument);
  const auto num_bytes = static_cast<size_t>(mode_.size_px.area()) * 2 + 4096;
  memory_.assign(request->count, std::string(num_bytes, '\0'));
  return 0;
}

int FakeCamera::TakeFrame(void* argument) {
  if (next_frame_ >= num_frames) return unplugged_at_end ? ENODEV : EAGAIN;
  if (next_frame_ >= num_allowed_ || queued_.empty() || !streaming_) return EAGAIN;
  const int number = next_frame_++;
  now_s_ += frame_time_s;
  if (const auto error = errors_at_frame.find(number); error != errors_at_frame.end())
    return error->second;
  FakeBuffer made = frame ? frame(number) : FakeBuffer{};
  auto* buffer = static_cast<v4l2_buffer*>(argument);
  buffer->index = queued_.front();
  queued_.pop_front();
  std::string& memory = memory_[buffer->index];
  std::copy_n(made.bytes.begin(), std::min(made.bytes.size(), memory.size()), memory.begin());
  buffer->bytesused = static_cast<uint32_t>(made.bytes.size());
  buffer->sequence = made.sequence ? made.sequence : static_cast<uint32_t>(number);
  buffer->flags = made.flags | (made.on_monotonic_clock ? V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC
                                                        : V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN);
  const double time_s = made.time_s >= 0.0 ? made.time_s : now_s_;
  const auto time_us = static_cast<int64_t>(std::floor(time_s * 1e6));
  buffer->timestamp.tv_sec = time_us / 1'000'000;
  buffer->timestamp.tv_usec = time_us % 1'000'000;
  return 0;
}

int FakeCamera::QueryControl(void* argument) const {
  auto* query = static_cast<v4l2_query_ext_ctrl*>(argument);
  const uint32_t after = query->id & ~(V4L2_CTRL_FLAG_NEXT_CTRL | V4L2_CTRL_FLAG_NEXT_COMPOUND);
  for (const CameraControl& control : controls) {
    if (control.id <= after) continue;  // they stand in the order of their numbers
    *query = {};
    query->id = control.id;
    query->type = control.menu.empty() ? V4L2_CTRL_TYPE_INTEGER : V4L2_CTRL_TYPE_MENU;
    Write(control.label, query->name, sizeof(query->name));
    query->minimum = control.lowest;
    query->maximum = control.highest;
    query->step = static_cast<uint64_t>(control.step);
    query->default_value = control.preset;
    query->flags = control.read_only ? V4L2_CTRL_FLAG_READ_ONLY : 0;
    return 0;
  }
  return EINVAL;
}

int FakeCamera::QueryMenu(void* argument) const {
  auto* item = static_cast<v4l2_querymenu*>(argument);
  for (const CameraControl& control : controls)
    if (control.id == item->id && control.menu.count(item->index)) {
      Write(control.menu.at(item->index), item->name, sizeof(item->name));
      return 0;
    }
  return EINVAL;
}

int FakeCamera::ControlValueOf(void* argument, bool is_set) {
  auto* asked = static_cast<v4l2_control*>(argument);
  for (CameraControl& control : controls) {
    if (control.id != asked->id) continue;
    if (is_set) {
      set_controls_.push_back(control.name);
      // Rounded to a step, as drivers do.
      control.value = asked->value - (asked->value - control.lowest) % control.step;
    }
    asked->value = static_cast<int32_t>(control.value.value_or(0));
    return 0;
  }
  return EINVAL;
}

cv::Mat GreyRamp(cv::Size size_px) {
  cv::Mat grey(size_px, CV_8UC1);
  for (int x = 0; x < size_px.width; ++x)
    grey.col(x).setTo(cv::Scalar(16 + 200 * x / size_px.width));
  return grey;
}

std::string AsYuyv(const cv::Mat& grey, int bytes_per_line) {
  std::string bytes;
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      bytes += static_cast<char>(grey.at<uchar>(y, x));
      bytes += '\x80';
    }
    bytes.append(static_cast<size_t>(std::max(0, bytes_per_line - 2 * grey.cols)), '\xee');
  }
  return bytes;
}

std::string AsNv12(const cv::Mat& grey, int bytes_per_line) {
  const auto padding = static_cast<size_t>(std::max(0, bytes_per_line - grey.cols));
  std::string bytes;
  for (int y = 0; y < grey.rows; ++y) {
    bytes.append(reinterpret_cast<const char*>(grey.ptr(y)), static_cast<size_t>(grey.cols));
    bytes.append(padding, '\xee');
  }
  for (int y = 0; y < grey.rows / 2; ++y)
    bytes.append(static_cast<size_t>(grey.cols), '\x80').append(padding, '\xee');
  return bytes;
}

std::string AsJpeg(const cv::Mat& picture, int restart_interval) {
  std::vector<uchar> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_RST_INTERVAL, restart_interval});
  return {bytes.begin(), bytes.end()};
}

std::string WithoutHuffmanTables(const std::string& jpeg) {
  std::string without = jpeg.substr(0, 2);
  for (size_t at = 2; at + 4 <= jpeg.size();) {
    const auto byte = [&](size_t i) {
      return static_cast<size_t>(static_cast<unsigned char>(jpeg[at + i]));
    };
    if (byte(1) == 0xda) return without + jpeg.substr(at);
    const size_t length = 2 + byte(2) * 256 + byte(3);
    if (byte(1) != 0xc4) without += jpeg.substr(at, length);
    at += length;
  }
  return without;
}

void MakeWebcam(FakeCamera* camera) {
  camera->formats = {
      {kFourccYuyv, "YUYV 4:2:2", {{{1280, 720}, {10.0, 5.0}}, {{640, 480}, {30.0, 15.0}}}},
      {kFourccMjpg, "Motion-JPEG", {{{1280, 720}, {30.0, 15.0}}, {{640, 480}, {60.0, 30.0}}}},
      {Fourcc('H', '2', '6', '4'), "H.264", {{{1920, 1080}, {60.0}}}}};
  const auto control = [](uint32_t id, const char* name, const char* label, int64_t lowest,
                          int64_t highest, int64_t step, int64_t value) {
    CameraControl made{id, name, label, lowest, highest, step, value};
    made.value = value;
    return made;
  };
  camera->controls = {
      control(V4L2_CID_BRIGHTNESS, "brightness", "Brightness", -64, 64, 1, 0),
      control(V4L2_CID_AUTO_WHITE_BALANCE, "white_balance_automatic", "White Balance, Automatic", 0,
              1, 1, 1),
      control(V4L2_CID_GAIN, "gain", "Gain", 0, 100, 5, 20),
      control(V4L2_CID_WHITE_BALANCE_TEMPERATURE, "white_balance_temperature",
              "White Balance Temperature", 2800, 6500, 1, 4600),
      control(V4L2_CID_EXPOSURE_AUTO, "auto_exposure", "Auto Exposure", 0, 3, 1, 3),
      control(V4L2_CID_EXPOSURE_ABSOLUTE, "exposure_time_absolute", "Exposure Time, Absolute", 3,
              2047, 1, 333),
      control(V4L2_CID_EXPOSURE_AUTO_PRIORITY, "exposure_dynamic_framerate",
              "Exposure, Dynamic Framerate", 0, 1, 1, 1),
      control(V4L2_CID_FOCUS_ABSOLUTE, "focus_absolute", "Focus, Absolute", 0, 250, 5, 0),
      control(V4L2_CID_FOCUS_AUTO, "focus_automatic_continuous", "Focus, Automatic Continuous", 0,
              1, 1, 1)};
  camera->controls[4].menu = {{1, "Manual Mode"}, {3, "Aperture Priority Mode"}};
}

}  // namespace poselift::testing
