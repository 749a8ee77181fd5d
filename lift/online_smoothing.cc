// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/online_smoothing.h"

#include <algorithm>
#include <utility>

#include "lift/body_smoothing.h"

namespace poselift {
namespace {

constexpr double kLongestGap_s = 10.0;  // nothing is foretold for so long

Motion SmoothStream(const Motion& motion, OnlineSmoother* smoother) {
  Motion smooth{motion.skeleton, motion.frame_time_s, {}};
  const auto take = [&] {
    while (auto frame = smoother->Take()) smooth.frames.push_back(std::move(frame->pose));
  };
  for (size_t t = 0; t < motion.frames.size(); ++t) {
    smoother->Add(static_cast<double>(t) * motion.frame_time_s, motion.frames[t]);
    take();
  }
  smoother->End();
  take();
  return smooth;
}

}  // namespace

MotionSmoother SmootherOnline(std::shared_ptr<const MotionCodebook> codebook, MotionSmoother rest,
                              const MotionFilterOptions& options) {
  const Skeleton body = codebook->skeleton;
  const auto of_body = [codebook = std::move(codebook), options](const Motion& motion,
                                                                 int max_gap_frames) {
    MotionFilterOptions of_motion = options;
    of_motion.max_gap_s = std::min(kLongestGap_s, max_gap_frames * motion.frame_time_s);
    OnlineSmoother smoother(codebook, of_motion);
    return SmoothStream(motion, &smoother);
  };
  return SmootherOfBody(body, of_body, std::move(rest));
}

}  // namespace poselift
