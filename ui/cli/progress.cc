// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <utility>

namespace poselift::cli {
namespace {

constexpr double kQuiet_s = 1.0;   // shorter work shows nothing
constexpr double kRedraw_s = 0.1;  // at least between two drawings
constexpr int kBarWidth = 20;
constexpr size_t kMaxColumns = 79;  // a wrapped line could not be erased
constexpr std::string_view kErase = "\r\x1b[K";

bool StderrIsTerminal() {
  const char* term = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

double SteadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string Clock(double duration_s) {
  constexpr double kLongest_s = 359999.0;  // 99:59:59
  const auto total = static_cast<int>(std::ceil(std::min(duration_s, kLongest_s)));
  if (total < 3600) return fmt::format("{}:{:02}", total / 60, total % 60);
  return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
}

}  // namespace

Progress::Progress(std::string title, int64_t num_items, std::string unit)
    : Progress(std::move(title), num_items, std::move(unit), &std::cerr, StderrIsTerminal(),
               SteadySeconds) {}

Progress::Progress(std::string title, int64_t num_items, std::string unit, std::ostream* out,
                   bool is_terminal, std::function<double()> now_s)
    : title_(std::move(title)),
      num_items_(num_items),
      unit_(std::move(unit)),
      out_(out),
      is_terminal_(is_terminal),
      now_s_(std::move(now_s)),
      start_s_(now_s_()) {}

Progress::~Progress() {
  if (drawn_) *out_ << kErase << std::flush;
}

void Progress::Advance(double fraction) {
  if (!is_terminal_) return;
  const std::scoped_lock lock(mutex_);
  if (!(fraction > fraction_)) return;
  fraction_ = std::min(fraction, 1.0);
  const double time_s = now_s_();
  if (time_s - start_s_ < kQuiet_s || (drawn_ && time_s - drawn_s_ < kRedraw_s)) return;
  drawn_s_ = time_s;
  drawn_ = true;
  *out_ << kErase << Line(time_s - start_s_) << std::flush;
}

ProgressFn Progress::Callback() {
  return [this](double fraction) { Advance(fraction); };
}

std::string Progress::Line(double elapsed_s) const {
  const int filled = static_cast<int>(fraction_ * kBarWidth);
  std::string line = fmt::format("{}  [{:#<{}}{:-<{}}] {:3.0f} %", title_, "", filled, "",
                                 kBarWidth - filled, 100.0 * fraction_);
  if (num_items_ > 0) {
    const double rate_per_s = fraction_ * static_cast<double>(num_items_) / elapsed_s;
    line += fmt::format("  {:.{}f} {}/s", rate_per_s, rate_per_s < 10.0 ? 1 : 0, unit_);
  }
  line += fmt::format("  {} left", Clock(elapsed_s * (1.0 - fraction_) / fraction_));
  return line.substr(0, kMaxColumns);
}

}  // namespace poselift::cli
