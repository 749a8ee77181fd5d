// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "src/pose3.h"

namespace poselift {

// Errors over time of poses x^(t) (3 x 23, metres) against the true x(t), both with
// the pelvis at the origin and of the same number of frames.

// Mean size of the second difference of the error e = x^ - x, mm a frame^2:
// |e(t+1) - 2 e(t) + e(t-1)|. Throws std::invalid_argument for fewer than 3 frames.
double Jitter_mm(const std::vector<Pose3>& estimate, const std::vector<Pose3>& truth);

// How many frames the estimate comes behind the truth: the shift s for which
//
//   sum over t of |v^(t) - v(t - s)|^2,   v(t) = x(t+1) - x(t),
//
// is least, over frames that are there for every s within kMostLag_frames; between
// whole frames by the parabola through the least and its neighbours. Velocities, so
// that a pose which is wrong all along does not count. Not beyond the most; 0 when
// nothing moves. Throws std::invalid_argument for fewer than kFewestLagFrames.
inline constexpr int kMostLag_frames = 5;
inline constexpr int kFewestLagFrames = 2 * kMostLag_frames + 2;
double Lag_frames(const std::vector<Pose3>& estimate, const std::vector<Pose3>& truth);

}  // namespace poselift
