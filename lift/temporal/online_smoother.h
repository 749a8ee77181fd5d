// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "lift/temporal/motion_filter.h"

namespace poselift {

// Poses as they arrive, measured with a noise that is estimated as it goes, filtered by
// MotionFilter, each feature by itself.
class OnlineSmoother {
 public:
  // codebook: with its mirror images. Throws InputError for wrong options.
  explicit OnlineSmoother(std::shared_ptr<const MotionCodebook> codebook,
                          const MotionFilterOptions& options = {});

  // The next frame: a pose on the codebook's skeleton in a world with y up, or one
  // that is not known. Throws InputError when time does not go on.
  void Add(double time_s, const SkeletonPose& measured);
  void End() { filter_.End(); }
  std::optional<SmoothedFrame> Take() { return filter_.Take(); }

 private:
  struct Measured {
    double time_s;
    SkeletonPose pose;
  };

  void Update(const SkeletonPose& measured, const MotionFilter::Prediction& prediction);
  void LearnNoise(const Measured& measured);

  MotionFilter filter_;
  std::deque<Measured> last_measured_;  // newest first, without a gap
  FeatureVector noise_variance_;
  double num_learned_ = 0.0;
};

}  // namespace poselift
