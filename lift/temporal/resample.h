// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <span>
#include <vector>

#include "src/motion.h"

namespace poselift {

// The motion at another frame time, from its first frame to at most its last.
// A frame between two is mixed of them. When a new frame is a whole number of old
// ones long, to the digits that motion files give (1e-3), every n-th is taken
// as it is: 60 Hz of 120 Hz are all even frames.
// Throws InputError for a frame time that is not positive.
Motion Resample(const Motion& motion, double frame_time_s);

// Poses at times that grow, of any steps, as a motion of even frames from the
// first time on, mixed as above. Frames beside an unknown pose, or between two
// poses more than two frame times apart, are unknown (motion.h).
// Throws InputError for a frame time that is not positive,
// std::invalid_argument unless there is a time for each pose.
Motion ResampleUneven(const Skeleton& skeleton, const std::vector<SkeletonPose>& poses,
                      std::span<const double> times_s, double frame_time_s);

}  // namespace poselift
