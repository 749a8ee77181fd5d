// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <sys/resource.h>

#include <csignal>
#include <cstddef>

namespace poselift::testing {

// While it lives no file of this process grows beyond so many bytes: a write comes back short, the
// next one fails (EFBIG). So fails a disk that is full, but of any size and for everybody.
class SizeLimit {
 public:
  explicit SizeLimit(size_t bytes) {
    old_action_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    rlimit limit = old_limit_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_action_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit old_limit_{};
  void (*old_action_)(int) = SIG_DFL;
};

}  // namespace poselift::testing
