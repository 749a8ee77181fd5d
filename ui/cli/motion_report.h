// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "lift/eval/evaluate_motion.h"

namespace poselift::cli {

// Means over the trials of an action, or over the actions: each counts the same.
struct MotionCell {
  double position_mm = 0.0, angle_deg = 0.0, acceleration_mm = 0.0, ms_per_frame = 0.0;
};

// The results of `evaluate motion` over one database, by action and in the mean of
// the actions.
class MotionReport {
 public:
  explicit MotionReport(std::vector<MotionEvaluation> rows);

  const std::vector<MotionEvaluation>& rows() const { return rows_; }
  bool HasPoints(const std::string& points) const;
  MotionCell MeanOf(const std::string& method, const std::string& points,
                    const std::string& action) const;
  MotionCell MeanOf(const std::string& method, const std::string& points) const;

  // A line for each method and set of control points, on stdout.
  void Print() const;
  // A bar chart of those of the methods that were run, by action: mm, or degrees.
  // Throws InputError when none was.
  std::string Chart(const std::vector<std::string>& wanted, const std::string& points,
                    bool degrees) const;

 private:
  std::vector<MotionEvaluation> rows_;
  std::vector<std::string> methods_, points_, actions_;  // in their first rows' order
};

}  // namespace poselift::cli
