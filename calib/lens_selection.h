// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "calib/camera_refinement.h"

namespace poselift {

// Huber's threshold over the noise: nearly all corners that are no outliers stay below it.
inline constexpr double kLossSigmas = 3.0;

// The largest lens model of which the last coefficients are told from 0 by five standard
// deviations, those of the corners' noise, loss_px / kLossSigmas. state: of a calibration from
// these views, where the fits start.
LensModel SelectLensModel(const CalibrationBoard& board, const std::vector<const BoardView*>& views,
                          double loss_px, CalibrationState state);

// The jackknife's standard deviations of the camera's parameters: views left out one by one,
// or in at most 10 groups. 0 with fewer than four views.
CameraParameters JackknifeSigma(const CalibrationBoard& board,
                                const std::vector<const BoardView*>& views,
                                const CalibrationState& state, LensModel lens, double loss_px);

}  // namespace poselift
