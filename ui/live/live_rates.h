// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cmath>
#include <deque>

namespace poselift {

// How fast pictures come and how late they are, over the last two seconds.
class LiveRates {
 public:
  // now_s and taken_s by one clock; taken_s: NaN where nobody knows.
  void Add(double now_s, double taken_s);
  double Rate_hz() const;    // 0 with fewer than two pictures
  double Latency_s() const;  // the median; NaN where nobody knows

 private:
  static constexpr double kSpan_s = 2.0;
  struct Picture {
    double at_s, latency_s;
  };
  std::deque<Picture> pictures_;
};

}  // namespace poselift
