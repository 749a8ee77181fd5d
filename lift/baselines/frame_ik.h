// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "lift/ik/articulation.h"
#include "lift/temporal/motion_method.h"
#include "lift/temporal/pose_prediction.h"

namespace poselift {

// What a rig without a motion model does: inverse kinematics frame by frame, as
// near to the last pose as the observed points allow.
class FrameIk : public MotionMethod {
 public:
  // sigmas: of the change of each feature from one frame to the next.
  FrameIk(const Skeleton& skeleton, double frame_time_s, const FeatureVector& sigmas);

  // At least one pose. Throws std::invalid_argument for none.
  void Begin(const std::vector<SkeletonPose>& first) override;
  SkeletonPose Next(const std::vector<TargetPoint>& observed) override;

 private:
  Articulation body_;
  double frame_time_s_;
  PosePrediction last_;
};

}  // namespace poselift
