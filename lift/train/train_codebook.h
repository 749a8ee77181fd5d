// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "lift/temporal/motion_codebook.h"
#include "lift/train/train_accelerations.h"
#include "src/progress.h"

namespace poselift {

// Learns a motion codebook: k-means over captured segments, each cell the mean of
// its members, and a regression for each (TrainAccelerations). Differences are weighed in metres,
// by how far they move the joints (LeverArms), the rates times the time between two samples.
struct CodebookOptions {
  int num_segments = 6000;
  int iterations = 15;
  // Cells of fewer are dissolved: their members join the nearest of the others, so
  // that no segment of the codebook is one that was captured.
  int least_members = 2;
  std::uint64_t seed = 1;
  AccelerationOptions accelerations;

  std::string Validate() const;
};

struct CodebookReport {
  std::vector<int> members;  // of each cell
  // Of the joints at the middle sample: RMS distance of a member's to its cell's.
  double rms_error_m = 0.0;
};

// segments: as SegmentsOf gives them, at least one; not mirrored (WithMirrored
// doubles the codebook instead). There are at most options.num_segments cells.
//
// The deviation of a cell of n members with the sum of squares S about its mean
// is sqrt((S + v) / n), with v the variance within all cells: few members alone
// say little. The record has the number of segments, the
// seed and the error; sources, command and commit are the caller's to fill in.
MotionCodebook TrainCodebook(const MotionCodebook& segments, const CodebookOptions& options,
                             const ProgressFn& progress, CodebookReport* report);

// Mean distance, metres, of the 23 joints at the middle sample of captured
// segments to those of the codebook's segment where they are nearest (RMS).
double MeanDistanceToNearest_m(const MotionCodebook& captured, const MotionCodebook& codebook);

}  // namespace poselift
