// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace poselift {

// Bars in groups, one of each series in each group, over a scale that begins at 0,
// with a legend: errors of methods, by action.
struct BarChart {
  std::string title;
  std::string unit;                 // of the scale: "mm"
  std::vector<std::string> groups;  // at most 12 or so fit
  std::vector<std::string> series;  // told apart by 8 colours, then again from the first
  Eigen::MatrixXd values;           // series x groups; a bar is left out where NaN or negative
  // Higher bars are cut off there and their number is written on them. 0: none is.
  double cut_off = 0.0;
};

// An SVG file. Throws std::invalid_argument when the sizes do not fit each other,
// or there is no group or no series.
std::string BarChartSvg(const BarChart& chart);

}  // namespace poselift
