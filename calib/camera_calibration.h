// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calib/calibration_board.h"
#include "calib/camera_refinement.h"
#include "src/camera.h"
#include "src/progress.h"

namespace poselift {

// The focal lengths, principal point and lens distortion of a camera from views of a flat
// board (Zhang 2000), refined over all corners at once:
//   1. a focal length from the views' homographies, the pose of each view;
//   2. all parameters together with a robust loss (camera_refinement.h);
//   3. views that fit much worse than the others are dropped, the worst first;
//   4. the distortion coefficients that the views tell from 0 (lens_selection.h);
//   5. the parameters' standard deviations, from the noise of the corners and again from
//      leaving out views, which also feels what several corners of a view have in common
//      (a board that is not flat, blur).
struct CalibrationOptions {
  std::optional<LensModel> lens;  // nothing: found
  int fewest_views = 3;
  double bad_view_ratio = 2.5;        // a view's error over the median of all: beyond it drops
  double least_bad_view_px = 0.1;     // but not for less than this above the median
  double least_turn_rad = 0.1;        // between some two views; else they are called parallel
  double largest_focal_sigma = 0.02;  // of the focal length; else it is called not known
  double largest_rms = 1e-3;  // of the larger side of the pictures; else the board is another

  // What is wrong, with its value; empty when nothing is.
  std::string Validate() const;
};

enum class CalibrationStatus {
  kNotRun,
  kDone,
  kTooFewViews,
  kViewsParallel,  // the focal length and the board's distance cannot be told apart
  kFocalUnknown,   // the focal length is open by more than largest_focal_sigma
  kBoardMisfits,   // the views fit, but by more than largest_rms
  kFailed,         // no camera fits the views
};

struct CalibratedView {
  bool is_used = false;
  double rms_px = 0.0;  // root mean squared distance of its corners; infinite: not seen at all
  Eigen::Isometry3d cam_from_board = Eigen::Isometry3d::Identity();
  Eigen::Matrix2Xd residuals_px;  // seen minus projected, of each corner
};

struct CalibrationResult {
  CalibrationStatus status = CalibrationStatus::kNotRun;
  Camera camera;
  LensModel lens = LensModel::kPinhole;
  // Standard deviations in the order of CameraParameterNames(), 0 for what is not free.
  CameraParameters sigma = CameraParameters::Zero();       // by the corners' noise
  CameraParameters view_sigma = CameraParameters::Zero();  // by leaving out views (jackknife)
  double rms_px = 0.0;                                     // over the corners of the views used
  double corner_sigma_px = 0.0;       // of x and of y of a corner, outliers aside
  std::vector<CalibratedView> views;  // as they came in

  bool IsUsable() const { return status == CalibrationStatus::kDone; }
  int num_used() const;
  // One line on what came out, or on what is wrong and what to do about it.
  std::string BriefReport() const;
};

// All pictures have size_px. Throws std::invalid_argument for options that are not valid
// and for ids that the board does not have.
CalibrationResult CalibrateCamera(const CalibrationBoard& board,
                                  const std::vector<BoardView>& views, cv::Size size_px,
                                  const CalibrationOptions& options = {},
                                  const ProgressFn& progress = {});

}  // namespace poselift
