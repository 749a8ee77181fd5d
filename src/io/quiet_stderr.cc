// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/quiet_stderr.h"

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

namespace poselift {
namespace {

std::mutex mutex;
int alive = 0;
int saved_stderr = -1;

}  // namespace

QuietStderr::QuietStderr() {
  const std::lock_guard lock(mutex);
  if (alive++ > 0) return;
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;  // noise, then: no reason to fail
  saved_stderr = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (saved_stderr >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietStderr::~QuietStderr() {
  const std::lock_guard lock(mutex);
  if (--alive > 0 || saved_stderr < 0) return;
  ::dup2(saved_stderr, STDERR_FILENO);
  ::close(saved_stderr);
  saved_stderr = -1;
}

}  // namespace poselift
