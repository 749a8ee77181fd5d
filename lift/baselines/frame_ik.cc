// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/frame_ik.h"

#include <stdexcept>

namespace poselift {

FrameIk::FrameIk(const Skeleton& skeleton, double frame_time_s, const FeatureVector& sigmas)
    : body_(skeleton), frame_time_s_(frame_time_s) {
  last_.whitening = sigmas.cwiseInverse().asDiagonal();
}

void FrameIk::Begin(const std::vector<SkeletonPose>& first) {
  if (first.empty()) throw std::invalid_argument("FrameIk: no first pose");
  last_.pose = first.back();
}

SkeletonPose FrameIk::Next(const std::vector<TargetPoint>& observed) {
  last_.pose = MostProbablePose(body_, last_, observed, frame_time_s_);
  return last_.pose;
}

}  // namespace poselift
