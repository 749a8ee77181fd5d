// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <opencv2/core/mat.hpp>

#include "calib/april_grid.h"
#include "calib/chessboard.h"
#include "src/camera.h"

namespace poselift::testing {

// The grey level, 0 to 255, at a place of the board's plane (metres, its frame).
using BoardPrint = std::function<double(const Eigen::Vector2d& x_in_board_m)>;

// With a white rim of one square, on a mid-grey wall.
BoardPrint PrintOf(const Chessboard& chessboard);
// Black on white paper with a rim of half a tag, on a mid-grey wall.
BoardPrint PrintOf(const AprilGrid& grid);

// What the camera sees of the plane, 8-bit grey, each pixel the mean over its area.
cv::Mat RenderBoard(const BoardPrint& print, const Camera& camera,
                    const Eigen::Isometry3d& cam_from_board);

}  // namespace poselift::testing
