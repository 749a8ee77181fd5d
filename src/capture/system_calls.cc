// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/system_calls.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>

namespace poselift {

int SystemCalls::Open(const std::string& path) {
  int fd = -1;
  do fd = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  while (fd < 0 && errno == EINTR);
  return fd < 0 ? -errno : fd;
}

void SystemCalls::Close(int fd) { ::close(fd); }

int SystemCalls::Ioctl(int fd, unsigned long request, void* argument) {
  int result = -1;
  do result = ::ioctl(fd, request, argument);
  while (result < 0 && errno == EINTR);
  return result < 0 ? errno : 0;
}

int SystemCalls::Map(int fd, size_t num_bytes, int64_t offset, void** memory) {
  *memory = ::mmap(nullptr, num_bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, offset);
  return *memory == MAP_FAILED ? errno : 0;
}

void SystemCalls::Unmap(void* memory, size_t num_bytes) { ::munmap(memory, num_bytes); }

bool SystemCalls::Poll(int fd, int timeout_ms) {
  const double end_s = Now_s() + timeout_ms / 1000.0;
  pollfd ready{fd, POLLIN, 0};
  int left_ms = timeout_ms;
  int result = -1;
  do {
    result = ::poll(&ready, 1, left_ms);
    left_ms = static_cast<int>((end_s - Now_s()) * 1000.0);
  } while (result < 0 && errno == EINTR && left_ms > 0);
  return result > 0;
}

double SystemCalls::Now_s() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

SystemCalls* RealSystem() {
  static SystemCalls system;
  return &system;
}

}  // namespace poselift
