// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>
#include <vector>

#include "src/skeleton.h"

namespace poselift {

// Poses that come one after the other, at uneven times and with some missing, as frames of an
// even grid: t_k = t_0 + k dt, t_0 the time of the first known pose. A frame between two poses
// is mixed of them (PoseBetween), however far apart they are. Where nothing is known, and on
// from there to the next known pose, a frame repeats the pose before. Nothing comes out before
// the first known pose.
class PoseGrid {
 public:
  static constexpr double kLongestGap_s = 3600.0;

  // Throws InputError for a frame time that is not positive.
  PoseGrid(const Skeleton& skeleton, double frame_time_s);

  // pose: nothing when it is not known. Returns the frames since the last time, up to this
  // one. Throws InputError when time does not go on, or by more than kLongestGap_s at once.
  std::vector<SkeletonPose> Add(double time_s, const std::optional<SkeletonPose>& pose);

 private:
  const Skeleton skeleton_;
  const double frame_time_s_;
  double first_s_ = 0.0, last_s_ = 0.0;  // of known poses; of all
  long num_frames_ = 0;
  bool has_time_ = false;
  bool is_last_known_ = false;
  std::optional<SkeletonPose> held_;  // the last known pose
};

}  // namespace poselift
