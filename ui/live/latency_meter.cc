// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/latency_meter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace poselift {

void LatencyMeter::Add(double time_s) {
  const double step = std::clamp(time_s / kStep_s, 0.0, static_cast<double>(counts_.size() - 1));
  ++counts_[static_cast<size_t>(step)];
  ++count_;
}

double LatencyMeter::Quantile_ms(double quantile) const {
  if (count_ == 0) return 0.0;
  const double wanted = quantile * static_cast<double>(count_);
  int64_t sum = 0;
  for (size_t i = 0; i < counts_.size(); ++i) {
    sum += counts_[i];
    if (static_cast<double>(sum) >= wanted) return 1e3 * kStep_s * (static_cast<double>(i) + 0.5);
  }
  return 1e3 * kLongest_s;
}

std::string LatencyMeter::QuantileText(double quantile) const {
  const double ms = Quantile_ms(quantile);
  return ms >= 1e3 * kLongest_s ? fmt::format("over {:g} s", kLongest_s)
                                : fmt::format("{:.1f} ms", ms);
}

}  // namespace poselift
