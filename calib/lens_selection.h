// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "calib/camera_refinement.h"

namespace poselift {

// What is learned of a camera by leaving out views. The state is that of a calibration from
// all of them, and the start of each fit.

// The smallest lens model that shows views left out of its fit as well as the best model
// does, but for one standard error of the difference over the views, or a twentieth of the
// squared error. With fewer than four views: k1 alone, nothing can be left out.
LensModel SelectLensModel(const CalibrationBoard& board, const std::vector<const BoardView*>& views,
                          const CalibrationState& state);

// The jackknife's standard deviations of the camera's parameters, views left out one by one,
// or in at most 20 groups. 0 with fewer than four views.
CameraParameters JackknifeSigma(const CalibrationBoard& board,
                                const std::vector<const BoardView*>& views,
                                const CalibrationState& state, LensModel lens, double loss_px);

}  // namespace poselift
