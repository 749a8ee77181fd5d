// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace poselift {
namespace {

// Okabe and Ito without their yellow, which is faint on paper, grey in its place.
constexpr std::array<const char*, 8> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};

}  // namespace

void PlotRange::Add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

PlotRange PlotRange::Widened(double part, double least) const {
  const double by = std::max(part * (high - low), 0.5 * (least - (high - low)));
  return {low - by, high + by};
}

double TickStep(const PlotRange& range, double count) {
  const double rough = (range.high - range.low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10.0 * power;
}

std::string TickText(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", std::abs(value) < 0.5 * step ? 0.0 : value, decimals);
}

const char* CurveColor(int index) { return kColors[static_cast<size_t>(index) % kColors.size()]; }

}  // namespace poselift
