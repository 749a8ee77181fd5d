// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <functional>

namespace poselift {

// Motion curves: a matrix of C channels x T frames at a fixed frame rate,
// radians or metres, already continuous over time (angles are unwrapped). An
// entry that is NaN is missing; a stretch of them is a gap.

// Throws InputError when an entry is infinite.
void RequireCurves(const Eigen::MatrixXd& curves);

// Throws InputError when the rate is not a positive number.
void RequireFrameRate(double frame_rate_hz);

// Hands every run of values between two gaps to smooth, as a curve of its own
// (never empty; its length must stay). A gap stays a gap: to smooth across it,
// fill it first (interpolation.h). Throws InputError as RequireCurves does.
Eigen::MatrixXd SmoothRuns(const Eigen::MatrixXd& curves,
                           const std::function<void(Eigen::VectorXd*)>& smooth);

}  // namespace poselift
