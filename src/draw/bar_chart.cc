// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/bar_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "src/draw/xml_text.h"

namespace poselift {
namespace {

constexpr double kWidth = 760.0, kHeight = 340.0;
constexpr double kLeft = 52.0, kRight = 12.0, kTop = 34.0, kBottom = 62.0;
constexpr double kLegendRow = 20.0;
constexpr double kGroupGap = 0.25;  // of a group's width

// Okabe and Ito: distinct in every common colour blindness.
constexpr std::array<const char*, 8> kColors = {"#999999", "#e69f00", "#56b4e9", "#009e73",
                                                "#d55e00", "#0072b2", "#cc79a7", "#f0e442"};

std::string Text(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     EscapedXml(text));
}

// 1, 2 or 5 times a power of ten, four to ten of which reach the top.
double TickStep(double top) {
  const double power = std::pow(10.0, std::floor(std::log10(top)));
  for (const double step : {0.1, 0.2, 0.5, 1.0})
    if (top <= 10.0 * step * power) return step * power;
  return power;
}

double Top(const BarChart& chart) {
  double top = 0.0;
  for (const double value : chart.values.reshaped())
    if (std::isfinite(value)) top = std::max(top, value);
  if (chart.cut_off > 0.0) top = std::min(top, chart.cut_off);
  if (top <= 0.0) return 1.0;
  const double step = TickStep(top);
  return std::ceil(top / step - 1e-9) * step;
}

std::string Scale(double top, const std::string& unit) {
  std::string svg;
  const double height = kHeight - kTop - kBottom;
  const double step = TickStep(top);
  for (int i = 0; i * step <= top * (1.0 + 1e-9); ++i) {
    const double y = kTop + height * (1.0 - i * step / top);
    svg += fmt::format(
        "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#dddddd\"/>\n",
        kLeft, kWidth - kRight, y, y);
    svg += Text(kLeft - 6.0, y + 4.0, "end", fmt::format("{:g}", i * step));
  }
  return svg + Text(kLeft - 6.0, kTop - 12.0, "end", unit);
}

std::string Bars(const BarChart& chart, double top) {
  std::string svg;
  const auto num_series = chart.values.rows(), num_groups = chart.values.cols();
  const double group_width = (kWidth - kLeft - kRight) / static_cast<double>(num_groups);
  const double width = group_width * (1.0 - kGroupGap) / static_cast<double>(num_series);
  for (Eigen::Index g = 0; g < num_groups; ++g) {
    const double left = kLeft + group_width * (static_cast<double>(g) + 0.5 * kGroupGap);
    for (Eigen::Index s = 0; s < num_series; ++s) {
      const double value = chart.values(s, g);
      if (!(value >= 0.0) || std::isinf(value)) continue;
      const double x = left + width * static_cast<double>(s);
      const double height = (kHeight - kTop - kBottom) * std::min(value / top, 1.0);
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", x,
          kHeight - kBottom - height, 0.92 * width, height,
          kColors[static_cast<size_t>(s) % kColors.size()]);
      if (value > top)
        svg += Text(x + 0.5 * width, kTop + 12.0, "middle", fmt::format("{:.0f}", value));
    }
    svg += Text(kLeft + group_width * (static_cast<double>(g) + 0.5), kHeight - kBottom + 18.0,
                "middle", chart.groups[static_cast<size_t>(g)]);
  }
  return svg;
}

// About; the font is the viewer's.
double TextWidth(const std::string& text) { return 6.6 * static_cast<double>(text.size()); }

// Rows as full as they go, below the groups' names. Returns where the picture ends.
double Legend(const std::vector<std::string>& series, std::string* svg) {
  double x = kLeft, y = kHeight - 26.0;
  for (size_t s = 0; s < series.size(); ++s) {
    const double width = 16.0 + TextWidth(series[s]);
    if (x > kLeft && x + width > kWidth - kRight) {
      x = kLeft;
      y += kLegendRow;
    }
    *svg +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"11\" height=\"11\" fill=\"{}\"/>\n", x,
                    y, kColors[s % kColors.size()]);
    *svg += Text(x + 16.0, y + 10.0, "start", series[s]);
    x += width + 18.0;
  }
  return y + 26.0;
}

}  // namespace

std::string BarChartSvg(const BarChart& chart) {
  if (chart.groups.empty() || chart.series.empty() ||
      chart.values.rows() != static_cast<Eigen::Index>(chart.series.size()) ||
      chart.values.cols() != static_cast<Eigen::Index>(chart.groups.size()))
    throw std::invalid_argument(fmt::format("bar chart: {} x {} values for {} series, {} groups",
                                            chart.values.rows(), chart.values.cols(),
                                            chart.series.size(), chart.groups.size()));
  const double top = Top(chart);
  std::string body =
      Text(0.5 * kWidth, 20.0, "middle", chart.title) + Scale(top, chart.unit) + Bars(chart, top);
  const double bottom = Legend(chart.series, &body);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
             "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
             "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
             kWidth, bottom) +
         body + "</svg>\n";
}

}  // namespace poselift
