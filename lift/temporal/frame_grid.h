// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <span>
#include <vector>

namespace poselift {

// Times of frames t_i as places n_i of an even grid, t_i = first + n_i dt: a
// camera's frames, of which some may be missing. The first guess of dt is the
// median of the steps, which rounds each step to whole frames; then dt is the
// slope of the straight line through (n_i, t_i), so that times rounded to
// milliseconds do not run away from it.
struct FrameGrid {
  double first_s = 0.0;
  double frame_time_s = 0.0;
  // Whether all times are within a twentieth of a frame of their places. Else
  // frame_time_s is the median step and there are no places.
  bool is_even = false;
  std::vector<int> places;  // n_i, growing, from 0
};

// Throws InputError when there are less than two times, when they do not grow,
// or when the grid would have more than ten million frames.
FrameGrid FitFrameGrid(std::span<const double> times_s);

}  // namespace poselift
