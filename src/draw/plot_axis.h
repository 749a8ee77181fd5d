// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cmath>
#include <string>

namespace poselift {

// What plots of angles share: the range of an axis, its round ticks, the colours of curves.

struct PlotRange {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;

  void Add(double value);  // nothing when it is not finite
  bool IsEmpty() const { return low > high; }
  // By a part of its width either way, and to a width of `least`.
  PlotRange Widened(double part, double least) const;
};

// 1, 2 or 5 times a power of ten, of which about `count` fit into the range.
double TickStep(const PlotRange& range, double count);
std::string TickText(double value, double step);

// "#0072b2"; of eight that the colour-blind tell apart on paper, then from the first again.
const char* CurveColor(int index);

}  // namespace poselift
