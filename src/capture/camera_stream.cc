// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/camera_stream.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "src/capture/fourcc.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;
// An error of the camera may pass; so many one after the other do not.
constexpr int kMostErrors = 16;

v4l2_buffer EmptyBuffer(uint32_t index = 0) {
  v4l2_buffer buffer{};
  buffer.type = kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

}  // namespace

std::string CameraOptions::Validate() const {
  if (wanted.size_px.width < 1 || wanted.size_px.height < 1)
    return fmt::format("size = {}x{}, wanted at least 1x1", wanted.size_px.width,
                       wanted.size_px.height);
  if (!(wanted.rate_hz >= 0.0 && wanted.rate_hz <= 1e4))
    return fmt::format("rate_hz = {}, wanted 0 to 10000", wanted.rate_hz);
  if (wanted.fourcc != 0 && !IsDecodable(wanted.fourcc))
    return fmt::format("format = {}, wanted {}", FourccText(wanted.fourcc), DecodableFormats());
  if (num_buffers < 2 || num_buffers > 32)
    return fmt::format("num_buffers = {}, wanted 2 to 32", num_buffers);
  return "";
}

CameraStream::CameraStream(const std::string& path, const CameraOptions& options,
                           SystemCalls* system)
    : device_(path, system) {
  if (const std::string flaw = options.Validate(); !flaw.empty()) throw InputError(path, flaw);
  formats_ = ListFormats(device_, options.wanted.size_px);
  Negotiate(options.wanted);
  for (const ControlValue& control : options.controls)
    controls_.push_back(SetControl(device_, control));
  try {
    ShareBuffers(options.num_buffers);
    Start();
  } catch (...) {
    Release();
    throw;
  }
}

CameraStream::~CameraStream() { Release(); }

void CameraStream::Negotiate(const CameraMode& wanted) {
  CameraMode nearest = ChooseMode(formats_, wanted);
  if (nearest.fourcc == 0) nearest = wanted;  // the driver does not list what it has, or not this
  asked_ = nearest;
  if (!wanted.size_px.empty()) asked_.size_px = wanted.size_px;
  if (wanted.rate_hz > 0.0) asked_.rate_hz = wanted.rate_hz;
  v4l2_format format{};
  format.type = kCapture;
  if (const int error = device_.Try(VIDIOC_G_FMT, &format)) {
    if (error != EINVAL) device_.Fail("ask for its format", error);
    throw InputError(device_.path(),
                     "has no format yet: start what writes into it, or name another camera; "
                     "`poselift doctor` lists them");
  }
  if (nearest.fourcc != 0) {
    v4l2_format asked = format;
    asked.fmt.pix = {};
    asked.fmt.pix.pixelformat = nearest.fourcc;
    asked.fmt.pix.width = static_cast<uint32_t>(nearest.size_px.width);
    asked.fmt.pix.height = static_cast<uint32_t>(nearest.size_px.height);
    asked.fmt.pix.field = V4L2_FIELD_ANY;
    const int error = device_.Try(VIDIOC_S_FMT, &asked);
    // Busy: whoever writes into the device has fixed its format.
    if (error && error != EBUSY && error != EINVAL) device_.Fail("set its format", error);
    device_.Do("ask for its format", VIDIOC_G_FMT, &format);
  }
  const v4l2_pix_format& pix = format.fmt.pix;
  given_.fourcc = pix.pixelformat;
  given_.size_px = cv::Size(static_cast<int>(pix.width), static_cast<int>(pix.height));
  if (!IsDecodable(given_.fourcc))
    throw InputError(device_.path(), fmt::format("gives {} pictures, wanted {}",
                                                 FourccText(given_.fourcc), DecodableFormats()));
  format_ = {given_.fourcc, given_.size_px, static_cast<int>(pix.bytesperline)};
  NegotiateRate();
}

void CameraStream::NegotiateRate() {
  v4l2_streamparm parameters{};
  parameters.type = kCapture;
  if (device_.Try(VIDIOC_G_PARM, &parameters)) return;  // a driver without rates
  v4l2_captureparm& capture = parameters.parm.capture;
  if (asked_.rate_hz > 0.0 && capture.capability & V4L2_CAP_TIMEPERFRAME) {
    capture.timeperframe = {1000, static_cast<uint32_t>(std::lround(1000.0 * asked_.rate_hz))};
    device_.Try(VIDIOC_S_PARM, &parameters);  // what comes of it is read back
    if (device_.Try(VIDIOC_G_PARM, &parameters)) return;
  }
  const v4l2_fract& interval = capture.timeperframe;
  if (interval.numerator > 0)
    given_.rate_hz = static_cast<double>(interval.denominator) / interval.numerator;
}

void CameraStream::ShareBuffers(int count) {
  v4l2_requestbuffers request{};
  request.count = static_cast<uint32_t>(count);
  request.type = kCapture;
  request.memory = V4L2_MEMORY_MMAP;
  device_.Do("share memory with it", VIDIOC_REQBUFS, &request);
  for (uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = EmptyBuffer(i);
    device_.Do("share memory with it", VIDIOC_QUERYBUF, &buffer);
    Buffer shared{nullptr, buffer.length};
    if (const int error =
            device_.system().Map(device_.fd(), buffer.length, buffer.m.offset, &shared.memory))
      device_.Fail("share memory with it", error);
    buffers_.push_back(shared);
    device_.Do("start streaming", VIDIOC_QBUF, &buffer);
  }
  if (buffers_.empty()) device_.Fail("share memory with it", ENOMEM);
}

void CameraStream::Start() {
  int type = kCapture;
  device_.Do("start streaming", VIDIOC_STREAMON, &type);
}

void CameraStream::Release() {
  int type = kCapture;
  device_.Try(VIDIOC_STREAMOFF, &type);
  for (const Buffer& buffer : buffers_) device_.system().Unmap(buffer.memory, buffer.num_bytes);
  buffers_.clear();
}

std::optional<CameraFrame> CameraStream::Read(double timeout_s) {
  SystemCalls& system = device_.system();
  const double end_s = system.Now_s() + timeout_s;
  for (double left_s = timeout_s; left_s >= 0.0; left_s = end_s - system.Now_s()) {
    const int timeout_ms = static_cast<int>(std::ceil(std::min(left_s, 3600.0) * 1000.0));
    if (!system.Poll(device_.fd(), timeout_ms)) return std::nullopt;
    if (auto frame = TakeBuffer()) return frame;
  }
  return std::nullopt;
}

// Nothing for a buffer that is broken.
std::optional<CameraFrame> CameraStream::TakeBuffer() {
  v4l2_buffer buffer = EmptyBuffer();
  const int error = device_.Try(VIDIOC_DQBUF, &buffer);
  if (error == EAGAIN || (error == EIO && ++num_errors_ < kMostErrors)) return std::nullopt;
  if (error)
    device_.Fail("take a picture from it", error == EINVAL || error == EPIPE ? EIO : error);
  num_errors_ = 0;
  if (buffer.index >= buffers_.size()) device_.Fail("take a picture from it", EIO);

  // A count that stands still, or starts anew, says nothing.
  const uint32_t step = last_sequence_ ? buffer.sequence - *last_sequence_ : 1;
  last_sequence_ = buffer.sequence;
  const int num_missing = step > 0 && step < (1U << 31) ? static_cast<int>(step - 1) : 0;
  counts_.lost += num_missing;
  num_lost_ += num_missing;

  const Buffer& shared = buffers_[buffer.index];
  const size_t num_bytes = std::min<size_t>(buffer.bytesused, shared.num_bytes);
  std::optional<CameraFrame> frame;
  if (buffer.flags & V4L2_BUF_FLAG_ERROR || num_bytes == 0) {
    ++counts_.bad;
    ++num_lost_;
  } else {
    frame.emplace();
    cv::Mat(1, static_cast<int>(num_bytes), CV_8UC1, shared.memory).copyTo(frame->bytes);
    frame->sequence = buffer.sequence;
    frame->num_lost = std::exchange(num_lost_, 0);
    const bool is_monotonic =
        (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    frame->monotonic_s = TimeOf(static_cast<double>(buffer.timestamp.tv_sec) +
                                    1e-6 * static_cast<double>(buffer.timestamp.tv_usec),
                                is_monotonic);
    ++counts_.given;
  }
  device_.Try(VIDIOC_QBUF,
              &buffer);  // the frame is whole whatever comes of it: the next call tells
  return frame;
}

double CameraStream::TimeOf(double driver_s, bool is_monotonic) {
  constexpr double kOldest_s = 5.0;
  constexpr double kTick_s = 1e-6;
  const double now_s = device_.system().Now_s();
  const bool is_sound =
      is_monotonic && driver_s > now_s - kOldest_s && driver_s <= now_s && driver_s > last_s_;
  last_s_ = is_sound ? driver_s : std::max(now_s, last_s_ + kTick_s);
  return last_s_;
}

}  // namespace poselift
