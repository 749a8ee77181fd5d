// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/online_smoothing.h"

#include <utility>

#include "lift/model_smoother.h"
#include "src/input_error.h"

namespace poselift {

MotionSmoother SmootherOnline(std::shared_ptr<const MotionCodebook> codebook,
                              const OnlineSmootherOptions& options) {
  return [codebook = std::move(codebook), options](const Motion& motion, int max_gap_frames) {
    if (!IsOnSkeletonOf(*codebook, motion.skeleton))
      throw InputError(motion.skeleton.name,
                       "found a skeleton that is not the motion model's, wanted a motion that "
                       "poselift lifted; smooth others with --method one-euro");
    OnlineSmootherOptions of_motion = options;
    of_motion.max_gap_s = max_gap_frames * motion.frame_time_s;
    OnlineSmoother smoother(codebook, of_motion);
    Motion smooth{motion.skeleton, motion.frame_time_s, {}};
    const auto take = [&] {
      while (auto frame = smoother.Take()) smooth.frames.push_back(std::move(frame->pose));
    };
    for (size_t t = 0; t < motion.frames.size(); ++t) {
      smoother.Add(static_cast<double>(t) * motion.frame_time_s, motion.frames[t]);
      take();
    }
    smoother.End();
    take();
    return smooth;
  };
}

}  // namespace poselift
