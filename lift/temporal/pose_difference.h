// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "lift/temporal/motion_features.h"

namespace poselift {

// What a pose differs by from another, in the rows of the features with a frame
// time of 1 s, to first order in the root's. With H the heading of `mean`:
//   rows 0..39       dofs - mean
//   rows 43, 40, 44  H^T (p - p_mean)
//   rows 41, 45, 42  H^T 2 vec(q conj(q_mean)), the short way round
FeatureVector PoseDifference(const SkeletonPose& pose, const SkeletonPose& mean);

// The way back: PoseDifference(MovedBy(mean, d), mean) = d, for turns of less than pi.
SkeletonPose MovedBy(const SkeletonPose& mean, const FeatureVector& difference);

}  // namespace poselift
