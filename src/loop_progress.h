// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>

#include "src/progress.h"

namespace poselift {

// How far a parallel loop is. What its listener throws, to stop it, may not leave the loop: it is
// kept until the loop has ended.
//
//   LoopProgress so_far(progress, n);
//   #pragma omp parallel for
//   for (size_t i = 0; i < n; ++i) {
//     if (so_far.IsStopped()) continue;
//     ...
//     so_far.Advance();
//   }
//   so_far.Finish();
class LoopProgress {
 public:
  LoopProgress(const ProgressFn& progress, size_t count) : progress_(progress), count_(count) {}

  bool IsStopped() const { return is_stopped_; }
  // One more is done; from any thread.
  void Advance() {
    const size_t done = ++done_;
    if (!progress_) return;
    try {
      progress_(static_cast<double>(done) / static_cast<double>(count_));
    } catch (...) {
      if (!is_stopped_.exchange(true)) reason_ = std::current_exception();
    }
  }
  // Throws what the listener threw.
  void Finish() const {
    if (reason_) std::rethrow_exception(reason_);
  }

 private:
  const ProgressFn& progress_;
  size_t count_;
  std::atomic<size_t> done_ = 0;
  std::atomic<bool> is_stopped_ = false;
  std::exception_ptr reason_;
};

}  // namespace poselift
