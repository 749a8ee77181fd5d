// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "calib/calibration_coverage.h"
#include "calib/camera_calibration.h"
#include "ui/cli/calibrate_views.h"

namespace poselift::cli {

struct CalibrationReport {
  const BoardFinder& finder;
  const SurveyedViews& surveyed;
  CalibrationResult result;
  CalibrationCoverage coverage;
  std::string out;      // where the camera was written
  std::string picture;  // empty: none
};

// Of the views that were used, by the calibrated camera, or of all by a guess when there is
// none.
CalibrationCoverage UsedCoverage(const CalibrationBoard& board, const SurveyedViews& surveyed,
                                 const CalibrationResult& result);

// On stdout, a line a picture; of a failed calibration what is known.
void PrintReport(const CalibrationReport& report);

// flaw: what is wrong with the board; empty when nothing is.
void WriteReportJson(const CalibrationReport& report, const std::string& flaw,
                     const std::string& path);

}  // namespace poselift::cli
