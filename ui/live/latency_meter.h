// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace poselift {

// Quantiles of times, to 0.1 ms up to kLongest_s, in constant memory.
class LatencyMeter {
 public:
  static constexpr double kLongest_s = 2.0;

  void Add(double time_s);
  // 0 to 1; 0 when nothing was added.
  double Quantile_ms(double quantile) const;
  // "12.3 ms", or that it is longer than is told apart.
  std::string QuantileText(double quantile) const;
  int64_t count() const { return count_; }
  int64_t num_over() const { return counts_.back(); }  // kLongest_s or longer

 private:
  static constexpr double kStep_s = 1e-4;
  std::array<int64_t, static_cast<std::size_t>(kLongest_s / kStep_s) + 1> counts_{};
  int64_t count_ = 0;
};

}  // namespace poselift
