// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/v4l2_device.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace poselift {
namespace {

// What to do about an error, or nothing where only the system's own words help.
std::string Advice(const std::string& path, int error) {
  switch (error) {
    case ENOENT:
      return "no such device; plug the camera in, and see `poselift doctor` for those there are";
    case EACCES:
    case EPERM:
      return "no permission to use it; join its group with `sudo usermod -aG video $USER`, then "
             "log in again";
    case EBUSY:
      return fmt::format("is used by another program; close that (`fuser -v {}` names it)", path);
    case ENODEV:
    case ENXIO:
      return "is gone: unplugged, or its driver was removed; plug it in again";
    case ENOSPC:
      return "found no room on its USB bus for this stream; take MJPG, a smaller size or a lower "
             "rate, or plug the camera into a port of its own";
    case ENOTTY:
      return "is no video device; `poselift doctor` lists those there are";
    case EIO:
      return "reports an error of the camera; unplug it and plug it in again";
    default:
      return "";
  }
}

// A text of the kernel's in a field of fixed size.
template <size_t kSize>
std::string Text(const __u8 (&field)[kSize]) {
  const auto* text = reinterpret_cast<const char*>(field);
  return {text, strnlen(text, kSize)};
}

}  // namespace

V4l2Device::V4l2Device(std::string path, SystemCalls* system)
    : path_(std::move(path)), system_(system), fd_(system->Open(path_)) {
  if (fd_ < 0) Fail("open it", -fd_);
  try {
    QueryCapability();
  } catch (...) {
    system_->Close(fd_);
    throw;
  }
}

V4l2Device::~V4l2Device() { system_->Close(fd_); }

int V4l2Device::Try(unsigned long request, void* argument) const {
  return system_->Ioctl(fd_, request, argument);
}

void V4l2Device::Do(const char* doing, unsigned long request, void* argument) const {
  if (const int error = Try(request, argument)) Fail(doing, error);
}

void V4l2Device::Fail(const char* doing, int error) const {
  const std::string advice = Advice(path_, error);
  if (!advice.empty()) throw InputError(path_, advice);
  throw InputError(path_, fmt::format("cannot {}: {}", doing, std::strerror(error)));
}

void V4l2Device::QueryCapability() {
  v4l2_capability capability{};
  const int error = Try(VIDIOC_QUERYCAP, &capability);
  if (error) Fail("ask what it is", error == EINVAL ? ENOTTY : error);
  name_ = Text(capability.card);
  driver_ = Text(capability.driver);
  bus_ = Text(capability.bus_info);
  // Of this node, not of the whole device.
  const uint32_t can = capability.capabilities & V4L2_CAP_DEVICE_CAPS ? capability.device_caps
                                                                      : capability.capabilities;
  if (!(can & V4L2_CAP_VIDEO_CAPTURE))
    throw NoCamera(path_, fmt::format("gives no pictures ({}: another of its nodes may, or its "
                                      "writer is not there yet); `poselift doctor` lists the "
                                      "cameras",
                                      name_));
  if (!(can & V4L2_CAP_STREAMING))
    throw NoCamera(path_, fmt::format("cannot stream ({}); wanted a camera that can", name_));
}

}  // namespace poselift
