// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/paced_frame_source.h"

#include <algorithm>
#include <chrono>

namespace poselift {
namespace {

double Now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void PacedFrameSource::Stop() {
  const std::lock_guard lock(mutex_);
  stop_ = true;
  stopped_.notify_all();
}

// False: it was stopped.
bool PacedFrameSource::WaitUntil(double time_s) {
  std::unique_lock lock(mutex_);
  const std::chrono::duration<double> wait(std::max(0.0, time_s - Now_s()));
  return !stopped_.wait_for(lock, wait, [this] { return stop_; });
}

std::optional<VideoFrame> PacedFrameSource::Next() {
  int num_lost = 0;
  std::optional<VideoFrame> late;
  for (;;) {
    auto frame = source_->Next();
    if (!frame && late) late->num_lost = num_lost - 1;
    if (!frame) return late;
    if (start_s_ < 0.0) start_s_ = Now_s() - frame->time_s;
    const double due_s = start_s_ + frame->time_s, step_s = frame->time_s - last_s_;
    last_s_ = frame->time_s;
    const double now_s = Now_s();
    if (now_s - due_s > step_s && step_s > 0.0) {
      num_lost += 1 + frame->num_lost;
      frame->monotonic_s = due_s;
      late = std::move(frame);
      continue;
    }
    if (!WaitUntil(due_s)) return std::nullopt;
    frame->monotonic_s = due_s;
    frame->num_lost += num_lost;
    return frame;
  }
}

}  // namespace poselift
