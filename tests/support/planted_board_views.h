// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "calib/calibration_board.h"
#include "src/camera.h"

namespace poselift::testing {

struct PlantedViews {
  std::vector<BoardView> views;
  std::vector<Eigen::Isometry3d> cam_from_board;
};

struct PlantedViewsOptions {
  int num_views = 12;
  double noise_px = 0.1;  // of x and of y
  double largest_tilt_rad = 0.8;
  // Corners outside of the picture are left out; without it a view shows the whole board.
  bool may_leave_picture = false;
};

// A board before a camera, at random places that fill the picture in the course of the views,
// at random tilts and distances.
PlantedViews PlantBoardViews(const CalibrationBoard& board, const Camera& camera,
                             const PlantedViewsOptions& options, std::mt19937_64* rng);

}  // namespace poselift::testing
