// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "calib/calibration_board.h"
#include "src/camera.h"

namespace poselift {

// px_from_board, 3 x 3: px ~ H (x, y, 1) for corners of the board in metres, by least squares.
// Nothing for fewer than four corners or for corners on one line.
std::optional<Eigen::Matrix3d> BoardHomography(const CalibrationBoard& board,
                                               const BoardView& view);

// The focal length of a camera with square pixels and its principal point in the middle of
// the picture, from views of a flat board (Zhang 2000): with h1, h2 the first columns of H
// about the middle, and w = 1 / f^2,
//
//   w (h11 h12 + h21 h22) + h31 h32 = 0,   w (h11^2 + h21^2 - h12^2 - h22^2) + h31^2 - h32^2 = 0
//
// A view that looks straight on says nothing of w. The views' answers are joined by their
// weighted median, which a wrong view does not move far. Nothing where none says anything.
std::optional<double> FocalLengthFromViews_px(const std::vector<Eigen::Matrix3d>& px_from_board,
                                              int width_px, int height_px);

// Where a known camera has the board. A flat board seen from afar has two poses that look
// nearly alike (Collins and Bartoli 2014, IPPE): both are refined, the better one is taken.
// Nothing when neither can be refined.
std::optional<Eigen::Isometry3d> FindBoardPose(const CalibrationBoard& board, const BoardView& view,
                                               const Camera& camera, double loss_px);

}  // namespace poselift
