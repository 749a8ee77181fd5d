// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace poselift {

// All that capture asks of the system, so that tests can put a made-up camera in its
// place. Errors are errno values; a call that a signal interrupts is made again.
class SystemCalls {
 public:
  virtual ~SystemCalls() = default;

  // For reading and writing, not blocking: the descriptor, or minus the error.
  virtual int Open(const std::string& path);
  virtual void Close(int fd);
  // 0 or the error.
  virtual int Ioctl(int fd, unsigned long request, void* argument);
  // Memory shared with the driver: 0 or the error.
  virtual int Map(int fd, size_t num_bytes, int64_t offset, void** memory);
  virtual void Unmap(void* memory, size_t num_bytes);
  // Waits for a picture: whether there is one, or an error for Ioctl to tell.
  virtual bool Poll(int fd, int timeout_ms);
  // CLOCK_MONOTONIC.
  virtual double Now_s();
};

// The real ones.
SystemCalls* RealSystem();

}  // namespace poselift
