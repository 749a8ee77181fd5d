// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "calib/calibration_board.h"
#include "calib/calibration_coverage.h"
#include "calib/camera_calibration.h"

namespace poselift {

// The picture's area with how often each cell was covered, the corners of all views and how
// far the calibrated camera is from each, as arrows many times longer than they are; dropped
// views in another colour. 8-bit BGR.
cv::Mat DrawCalibration(const std::vector<BoardView>& views, const CalibrationResult& result,
                        const CalibrationCoverage& coverage, const std::string& title);

}  // namespace poselift
