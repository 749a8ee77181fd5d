// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>

#include "src/progress.h"

namespace poselift::cli {

// A progress bar on stderr:
//   train  [########------------]  40 %  1250 poses/s  0:36 left
// It shows only on a terminal and only once the work has lasted a second. The
// destructor erases it, so that what is printed next starts on a clean line.
//
//   Progress progress("train", num_poses, "poses");
//   Train(poses, options, progress.Callback());
class Progress {
 public:
  // num_items (0: not known) and unit are for the rate alone.
  explicit Progress(std::string title, int64_t num_items = 0, std::string unit = "");
  // For tests: draws on out when is_terminal, by the time that now_s tells.
  Progress(std::string title, int64_t num_items, std::string unit, std::ostream* out,
           bool is_terminal, std::function<double()> now_s);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Any thread may call it. Steps back and NaN are ignored.
  void Advance(double fraction);
  // Valid as long as the bar is.
  ProgressFn Callback();

 private:
  std::string Line(double elapsed_s) const;

  const std::string title_;
  const int64_t num_items_;
  const std::string unit_;
  std::ostream* const out_;
  const bool is_terminal_;
  const std::function<double()> now_s_;
  const double start_s_;

  std::mutex mutex_;  // guards what follows
  double fraction_ = 0.0;
  double drawn_s_ = 0.0;
  bool drawn_ = false;
};

}  // namespace poselift::cli
