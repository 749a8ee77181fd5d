// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "src/capture/system_calls.h"
#include "src/input_error.h"

namespace poselift {

// A video device, but one that gives no pictures.
class NoCamera : public InputError {
 public:
  using InputError::InputError;
};

// An open video device of the Linux kernel (V4L2), closed by the destructor.
//
// Throws InputError, saying what to do, for no such device, no permission, what is no
// video device; NoCamera for one without pictures (a webcam's second node has metadata).
class V4l2Device {
 public:
  explicit V4l2Device(std::string path, SystemCalls* system = RealSystem());
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  const std::string& path() const { return path_; }
  const std::string& name() const { return name_; }      // "HD Pro Webcam C920"
  const std::string& driver() const { return driver_; }  // "uvcvideo"
  const std::string& bus() const { return bus_; }        // "usb-0000:00:14.0-1"

  SystemCalls& system() const { return *system_; }
  int fd() const { return fd_; }
  // 0 or errno.
  int Try(unsigned long request, void* argument) const;
  // Throws InputError where it fails; doing: "start streaming".
  void Do(const char* doing, unsigned long request, void* argument) const;
  [[noreturn]] void Fail(const char* doing, int error) const;

 private:
  void QueryCapability();

  std::string path_;
  SystemCalls* system_;
  int fd_ = -1;
  std::string name_, driver_, bus_;
};

}  // namespace poselift
