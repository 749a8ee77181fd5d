// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/motion_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src/draw/bar_chart.h"
#include "src/input_error.h"

namespace poselift::cli {
namespace {

// Higher bars are cut off at so many times the median.
constexpr double kCutOff = 4.0;

void AddOnce(const std::string& name, std::vector<std::string>* names) {
  if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
}

MotionCell Mean(const std::vector<MotionCell>& cells) {
  MotionCell mean;
  for (const MotionCell& cell : cells) {
    mean.position_mm += cell.position_mm / static_cast<double>(cells.size());
    mean.angle_deg += cell.angle_deg / static_cast<double>(cells.size());
    mean.acceleration_mm += cell.acceleration_mm / static_cast<double>(cells.size());
    mean.ms_per_frame += cell.ms_per_frame / static_cast<double>(cells.size());
  }
  return mean;
}

double Median(Eigen::VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

MotionReport::MotionReport(std::vector<MotionEvaluation> rows) : rows_(std::move(rows)) {
  for (const MotionEvaluation& row : rows_) {
    AddOnce(row.method, &methods_);
    AddOnce(row.control_points, &points_);
    AddOnce(row.action, &actions_);
  }
}

bool MotionReport::HasPoints(const std::string& points) const {
  return std::find(points_.begin(), points_.end(), points) != points_.end();
}

MotionCell MotionReport::MeanOf(const std::string& method, const std::string& points,
                                const std::string& action) const {
  std::vector<MotionCell> cells;
  for (const MotionEvaluation& row : rows_)
    if (row.method == method && row.control_points == points && row.action == action)
      cells.push_back({row.position_mm, row.angle_deg, row.acceleration_mm, row.ms_per_frame});
  return Mean(cells);
}

MotionCell MotionReport::MeanOf(const std::string& method, const std::string& points) const {
  std::vector<MotionCell> cells;
  for (const std::string& action : actions_) cells.push_back(MeanOf(method, points, action));
  return Mean(cells);
}

void MotionReport::Print() const {
  fmt::print("{:<28} {:>6}", "method", "points");
  for (const std::string& action : actions_) fmt::print(" {:>16}", action);
  fmt::print(" {:>16} {:>9} {:>8}\n", "mean", "jitter mm", "ms/frame");
  for (const std::string& method : methods_)
    for (const std::string& points : points_) {
      fmt::print("{:<28} {:>6}", method, points);
      for (const std::string& action : actions_) {
        const MotionCell cell = MeanOf(method, points, action);
        fmt::print(" {:>6.1f} mm {:>4.1f} deg", cell.position_mm, cell.angle_deg);
      }
      const MotionCell mean = MeanOf(method, points);
      fmt::print(" {:>6.1f} mm {:>4.1f} deg {:>9.2f} {:>8.2f}\n", mean.position_mm, mean.angle_deg,
                 mean.acceleration_mm, mean.ms_per_frame);
    }
}

std::string MotionReport::Chart(const std::vector<std::string>& wanted, const std::string& points,
                                bool degrees) const {
  std::vector<std::string> methods;
  for (const std::string& method : wanted)
    if (std::find(methods_.begin(), methods_.end(), method) != methods_.end())
      methods.push_back(method);
  if (methods.empty()) throw InputError("bar chart: none of its methods was run");
  BarChart chart{degrees ? "Mean angle error, " + points + " control points"
                         : "Mean joint error, " + points + " control points",
                 degrees ? "degrees" : "mm",
                 actions_,
                 methods,
                 {},
                 0.0};
  chart.values.resize(static_cast<Eigen::Index>(methods.size()),
                      static_cast<Eigen::Index>(actions_.size()));
  for (Eigen::Index m = 0; m < chart.values.rows(); ++m)
    for (Eigen::Index a = 0; a < chart.values.cols(); ++a) {
      const MotionCell cell =
          MeanOf(methods[static_cast<size_t>(m)], points, actions_[static_cast<size_t>(a)]);
      chart.values(m, a) = degrees ? cell.angle_deg : cell.position_mm;
    }
  chart.cut_off = kCutOff * Median(chart.values.reshaped());
  return BarChartSvg(chart);
}

}  // namespace poselift::cli
