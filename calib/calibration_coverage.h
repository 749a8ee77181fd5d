// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/calibration_board.h"
#include "src/camera.h"

namespace poselift {

// What views say a camera by: where in the picture corners were seen, how large the board was
// and how it was tilted. A lens is known only where corners were, the focal length only by tilt.
struct CalibrationCoverage {
  static constexpr int kCells = 6;                                  // a side
  Eigen::MatrixXi corners = Eigen::MatrixXi::Zero(kCells, kCells);  // seen in each cell of it
  int num_views = 0;
  double share = 0.0;                              // of the cells that have corners
  double smallest_size = 0.0, largest_size = 0.0;  // of the board over the picture's diagonal
  // How far the board's right edge (left) or lower edge (upper) was turned away, at most.
  double left_rad = 0.0, right_rad = 0.0, up_rad = 0.0, down_rad = 0.0;
  // What to show next, the most useful first: "hold the board to the lower left"; none when
  // there is enough.
  std::vector<std::string> hints;
};

// camera: as far as it is known; a focal length that is right by a third will do.
CalibrationCoverage CoverageOf(const CalibrationBoard& board,
                               const std::vector<const BoardView*>& views,
                               const std::vector<Eigen::Isometry3d>& cam_from_board,
                               const Camera& camera);

// The same while the camera is not known yet: poses by a focal length that is guessed.
CalibrationCoverage CoverageOf(const CalibrationBoard& board,
                               const std::vector<const BoardView*>& views, int width_px,
                               int height_px);

}  // namespace poselift
