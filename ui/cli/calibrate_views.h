// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "calib/board_survey.h"
#include "calib/calibration_board.h"
#include "calib/view_chooser.h"
#include "ui/cli/camera_options.h"

namespace poselift::cli {

struct ViewsOptions {
  double every_s = 0.25;   // of a video: time between frames that are looked at
  double seconds = 120.0;  // of a camera: at most
  CameraChoice device;
  ViewChooserOptions chooser;
};

// A picture that was looked at, or of a video one that was chosen.
struct SurveyedPicture {
  std::string name;     // "a.jpg", "frame 250 (8.33 s)"
  std::string skipped;  // why; empty: it has a view
};

struct SurveyedViews {
  cv::Size size_px;
  std::vector<SurveyedPicture> pictures;
  std::vector<BoardView> views;  // of those that were not skipped, in order
  BoardSurvey survey;
};

// Pictures, folders of them, one video or one camera. Of pictures of several sizes the most
// frequent one counts. A camera is watched until its views are enough, the time is over or
// the user interrupts (SIGINT); meanwhile each change is a line of JSON on stderr:
//   {"time_s": 4.2, "views": 5, "share": 0.47, "hint": "hold the board to the lower left ..."}
// Throws InputError for what cannot be read.
SurveyedViews SurveyViews(const std::vector<std::string>& inputs, const ViewsOptions& options,
                          BoardFinder* finder);

}  // namespace poselift::cli
