// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/frame_times.h"

#include <exception>
#include <utility>

#include "src/io/video.h"

namespace poselift {

FrameTimes::FrameTimes(const std::filesystem::path& path) : thread_([this, path] { Run(path); }) {}

FrameTimes::FrameTimes(std::vector<double> times_s) : times_s_(std::move(times_s)) {}

FrameTimes::~FrameTimes() {
  is_ended_ = true;
  if (thread_.joinable()) thread_.join();
}

std::optional<double> FrameTimes::Of_s(int index) const {
  const std::scoped_lock lock(mutex_);
  const auto at = static_cast<size_t>(index);
  return at < times_s_.size() ? std::optional(times_s_[at]) : std::nullopt;
}

void FrameTimes::WaitUntilRead() {
  if (thread_.joinable()) thread_.join();
}

void FrameTimes::Run(const std::filesystem::path& path) {
  try {
    VideoFile video(path);
    while (!is_ended_) {
      const auto time_s = video.Skip_s();
      if (!time_s) return;
      const std::scoped_lock lock(mutex_);
      times_s_.push_back(*time_s);
    }
  } catch (const std::exception&) {  // who reads the pictures says so
  }
}

}  // namespace poselift
