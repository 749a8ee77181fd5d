// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/sequence_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/draw/angle_plot.h"
#include "src/draw/bar_chart.h"
#include "src/joint_angles.h"

namespace poselift::cli {
namespace {

template <typename T>
bool Contains(const std::vector<T>& values, const T& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

template <typename T>
void AddOnce(const T& value, std::vector<T>* values) {
  if (!Contains(*values, value)) values->push_back(value);
}

AngleCurve CurveOf(std::string name, const Motion& motion, const std::string& angle,
                   int color_index) {
  const auto& angles = JointAngles();
  const auto row = std::find_if(angles.begin(), angles.end(),
                                [&](const JointAngle& a) { return a.name == angle; });
  const auto num_frames = static_cast<Eigen::Index>(motion.frames.size());
  return {std::move(name),
          motion.frame_time_s *
              Eigen::VectorXd::LinSpaced(num_frames, 0.0, static_cast<double>(num_frames - 1)),
          ReadJointAnglesDeg(motion).row(row - angles.begin()),
          {},
          color_index};
}

}  // namespace

SequenceReport::SequenceReport(std::vector<SequenceEvaluation> rows) : rows_(std::move(rows)) {
  for (const SequenceEvaluation& row : rows_) {
    AddOnce(row.method, &methods_);
    AddOnce(row.noise_px, &noises_px_);
    AddOnce(row.trial, &trials_);
  }
}

SequenceMean SequenceReport::MeanOf(const std::string& method, double noise_px) const {
  SequenceErrors sum = SequenceErrors::Zero(), squares = SequenceErrors::Zero();
  double count = 0.0;
  for (const SequenceEvaluation& row : rows_)
    if (row.method == method && row.noise_px == noise_px) {
      sum += row.errors;
      ++count;
    }
  const SequenceErrors mean = sum / count;
  for (const SequenceEvaluation& row : rows_)
    if (row.method == method && row.noise_px == noise_px) squares += (row.errors - mean).square();
  return {mean, (squares / (count * std::max(1.0, count - 1.0))).sqrt()};
}

const SequenceEvaluation* SequenceReport::Find(const std::string& method, double noise_px,
                                               const std::string& trial) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const SequenceEvaluation& row) {
    return row.method == method && row.noise_px == noise_px && row.trial == trial;
  });
  return found == rows_.end() ? nullptr : &*found;
}

std::string SequenceReport::Best(double noise_px, const std::vector<std::string>& but) const {
  std::string best;
  double best_mm = HUGE_VAL;
  for (const std::string& method : methods_) {
    const double cam_mm = MeanOf(method, noise_px).mean[measure::kCam_mm];
    if (method == kTrueJoints || Contains(but, method) || !(cam_mm < best_mm)) continue;
    best = method;
    best_mm = cam_mm;
  }
  return best;
}

void SequenceReport::Print() const {
  fmt::print("{:>8} {:<30} {:>12} {:>12} {:>12} {:>12} {:>12} {:>14} {:>12} {:>9}\n", "noise px",
             "method", "CAM mm", "PA mm", "root mm", "degrees", "jitter mm", "lag frames",
             "bones %", "ms/frame");
  for (const double noise_px : noises_px_)
    for (const std::string& method : methods_) {
      const SequenceMean cell = MeanOf(method, noise_px);
      fmt::print("{:>8g} {:<30}", noise_px, method);
      for (int i = 0; i < measure::kMsPerFrame; ++i) {
        const bool is_lag = i == measure::kLag_frames;
        fmt::print(" {:>{}.{}f} ±{:>4.{}f}", cell.mean[i], is_lag ? 8 : 6, is_lag ? 2 : 1,
                   cell.standard_error[i], is_lag ? 2 : 1);
      }
      fmt::print(" {:>9.1f}\n", cell.mean[measure::kMsPerFrame]);
    }
  PrintCalibration("pelvis, spine, head", measure::kTrunkSigmas);
  PrintCalibration("arms and legs", measure::kLimbSigmas);
}

void SequenceReport::PrintCalibration(const char* angles, int first_measure) const {
  for (const double noise_px : noises_px_)
    for (const std::string& method : methods_) {
      const Eigen::Array3d share = MeanOf(method, noise_px).mean.segment<3>(first_measure);
      if (std::isnan(share[0])) continue;
      fmt::print(
          "{:>8g} {}, angles of {}: the true ones are within one standard deviation {:.1f} %, "
          "within two {:.1f} %; two thirds within {:.2f}\n",
          noise_px, method, angles, 100.0 * share[0], 100.0 * share[1], share[2]);
    }
}

std::string SequenceReport::Chart(const std::vector<std::string>& methods, double noise_px) const {
  BarChart chart{fmt::format("Joint error (CAM), labels with {:g} px of noise", noise_px),
                 "mm",
                 trials_,
                 methods,
                 {},
                 0.0};
  chart.groups.emplace_back("mean");
  chart.values.resize(static_cast<Eigen::Index>(methods.size()),
                      static_cast<Eigen::Index>(chart.groups.size()));
  for (Eigen::Index m = 0; m < chart.values.rows(); ++m) {
    const std::string& method = methods[static_cast<size_t>(m)];
    for (size_t t = 0; t < trials_.size(); ++t) {
      const SequenceEvaluation* row = Find(method, noise_px, trials_[t]);
      chart.values(m, static_cast<Eigen::Index>(t)) =
          row ? row->errors[measure::kCam_mm] : std::nan("");
    }
    chart.values(m, chart.values.cols() - 1) = MeanOf(method, noise_px).mean[measure::kCam_mm];
  }
  return BarChartSvg(chart);
}

std::string SequenceReport::Plot(const std::vector<std::string>& methods, double noise_px,
                                 const SequenceTrial& trial, const std::string& angle) const {
  constexpr int kBlack = 6;
  AnglePlot plot;
  plot.title = fmt::format("{}, {}, labels with {:g} px of noise", angle, trial.name, noise_px);
  int color_index = 0;
  Motion motion = trial.standard;
  for (const std::string& method : methods)
    if (const SequenceEvaluation* row = Find(method, noise_px, trial.name)) {
      motion.frames = row->poses;
      plot.curves.push_back(CurveOf(method, motion, angle, color_index++));
    }
  plot.curves.push_back(CurveOf("truth", trial.standard, angle, kBlack));
  return AnglePlotSvg(plot);
}

}  // namespace poselift::cli
