// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "lift/eval/evaluate_sequence.h"

namespace poselift::cli {

// Over the trials, each counting the same.
struct SequenceMean {
  SequenceErrors mean = SequenceErrors::Zero();
  SequenceErrors standard_error = SequenceErrors::Zero();  // of the mean
};

// The results of `evaluate sequence`.
class SequenceReport {
 public:
  explicit SequenceReport(std::vector<SequenceEvaluation> rows);

  const std::vector<SequenceEvaluation>& rows() const { return rows_; }
  const std::vector<std::string>& methods() const { return methods_; }
  const std::vector<double>& noises_px() const { return noises_px_; }
  const std::vector<std::string>& trials() const { return trials_; }

  // NaN when there is no such row.
  SequenceMean MeanOf(const std::string& method, double noise_px) const;
  // Null when there is no such row.
  const SequenceEvaluation* Find(const std::string& method, double noise_px,
                                 const std::string& trial) const;
  // Of the methods, but for the true joints and `but`, the one of the least mean
  // CAM; empty when there is none.
  std::string Best(double noise_px, const std::vector<std::string>& but) const;

  // A line for each noise and method, on stdout.
  void Print() const;
  // CAM by trial and in the mean, as bars (SVG).
  std::string Chart(const std::vector<std::string>& methods, double noise_px) const;
  // One joint angle (src/joint_angles.h) over time: the trial's and that of the
  // methods (SVG).
  std::string Plot(const std::vector<std::string>& methods, double noise_px,
                   const SequenceTrial& trial, const std::string& angle) const;

 private:
  // Of the methods that say how sure they are.
  void PrintCalibration(const char* angles, int first_measure) const;

  std::vector<SequenceEvaluation> rows_;
  std::vector<std::string> methods_, trials_;  // in their first rows' order
  std::vector<double> noises_px_;
};

}  // namespace poselift::cli
