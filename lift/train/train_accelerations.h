// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "lift/temporal/motion_codebook.h"
#include "src/progress.h"

namespace poselift {

// Fits the AccelerationModels of a codebook (motion_codebook.h): around each of its
// segments a principal component regression with the Gaussian weights of Eq. (7) of
// the motion paper,
//   omega_k = exp(-|x_k - x_c|^2 / (2 h^2)),   h = bandwidth |x_K - x_c|,
// over the K nearest captured segments, mirror images among them. Differences are
// weighed as TrainCodebook does, in metres.
struct AccelerationOptions {
  int num_neighbours = 300;
  double bandwidth = 0.35;
  // Captured segments next to each other say the same: of any that are closer in
  // time, by columns, one is taken.
  int apart = 5;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// captured: as SegmentsOf gives them, at least one. Deviations are of the weighted
// residuals, for as many degrees of freedom as the weights leave.
void TrainAccelerations(const MotionCodebook& captured, const AccelerationOptions& options,
                        const ProgressFn& progress, MotionCodebook* codebook);

}  // namespace poselift
