// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>

#include "lift/smooth_motion.h"
#include "lift/temporal/online_smoother.h"

namespace poselift {

// A whole motion as a stream: its frames as they come out of an OnlineSmoother.
// max_gap_frames, up to 10 s, goes before options.max_gap_s; of a longer gap the first frames
// are filled, for nobody knew how long it would be. The codebook stays with the
// smoother; rest and errors as with SmootherOfBody, and
// InputError for wrong options when it is called.
MotionSmoother SmootherOnline(std::shared_ptr<const MotionCodebook> codebook, MotionSmoother rest,
                              const MotionFilterOptions& options = {});

}  // namespace poselift
