// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "lift/lift_photo.h"

namespace poselift {

// Which alternative of each frame of a body in motion: those that together are
// the likeliest, so that a leg does not flip in depth from one frame to the next,
//
//   min over a_1 ... a_T of  sum_t cost_t(a_t) + |Y_t(a_t) - Y_t-1(a_t-1)|^2 / sigma_t^2
//
// Y: the 23 joints in cam, sigma_t^2 = drift_m2_per_s times the time between the
// frames. By dynamic programming (Viterbi). A frame without alternatives is
// passed over, and gets -1.
std::vector<int> ChooseAlternatives(const std::vector<LiftResult>& frames, double frame_time_s,
                                    double drift_m2_per_s = 0.7);

}  // namespace poselift
