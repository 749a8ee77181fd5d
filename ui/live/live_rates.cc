// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/live_rates.h"

#include <algorithm>
#include <vector>

namespace poselift {

void LiveRates::Add(double now_s, double taken_s) {
  pictures_.push_back({now_s, now_s - taken_s});
  while (now_s - pictures_.front().at_s > kSpan_s) pictures_.pop_front();
}

double LiveRates::Rate_hz() const {
  if (pictures_.size() < 2) return 0.0;
  const double span_s = pictures_.back().at_s - pictures_.front().at_s;
  return span_s > 0.0 ? static_cast<double>(pictures_.size() - 1) / span_s : 0.0;
}

double LiveRates::Latency_s() const {
  std::vector<double> known_s;
  for (const Picture& picture : pictures_)
    if (std::isfinite(picture.latency_s)) known_s.push_back(picture.latency_s);
  if (known_s.empty()) return std::nan("");
  const auto middle = known_s.begin() + static_cast<std::ptrdiff_t>(known_s.size() / 2);
  std::nth_element(known_s.begin(), middle, known_s.end());
  return *middle;
}

}  // namespace poselift
