// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "src/motion.h"

namespace poselift {

// The motion at another frame time, from its first frame to at most its last.
// A frame between two is their linear mixture, of the root's rotation by slerp,
// of an angle the short way round. When a new frame is a whole number of old
// ones long, to the digits that motion files give (1e-3), every n-th is taken
// as it is: 60 Hz of 120 Hz are all even frames.
// Throws InputError for a frame time that is not positive.
Motion Resample(const Motion& motion, double frame_time_s);

}  // namespace poselift
