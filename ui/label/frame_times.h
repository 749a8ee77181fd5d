// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace poselift {

// Of the frames of videos that have been read, by their paths as labels have them.
using VideoTimes = std::map<std::string, std::vector<double>>;

// The times of a video's frames, read in a thread of its own from the beginning on: what there is
// to know before one can go to any frame and be sure which it is.
class FrameTimes {
 public:
  explicit FrameTimes(const std::filesystem::path& path);
  explicit FrameTimes(std::vector<double> times_s);  // read before
  ~FrameTimes();
  FrameTimes(const FrameTimes&) = delete;
  FrameTimes& operator=(const FrameTimes&) = delete;

  // Nothing where it was not read yet, or cannot be read.
  std::optional<double> Of_s(int index) const;
  void WaitUntilRead();  // for programs without patience

 private:
  void Run(const std::filesystem::path& path);

  mutable std::mutex mutex_;
  std::vector<double> times_s_;  // guarded by mutex_
  std::atomic<bool> is_ended_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace poselift
