// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/pose_grid.h"

#include <fmt/format.h>

#include <cmath>

#include "src/input_error.h"
#include "src/pose_between.h"

namespace poselift {
namespace {

constexpr double kSameTime = 1e-3;  // in frame times

}  // namespace

PoseGrid::PoseGrid(const Skeleton& skeleton, double frame_time_s)
    : skeleton_(skeleton), frame_time_s_(frame_time_s) {
  if (!(frame_time_s > 0.0))
    throw InputError(fmt::format("found a frame time of {} s, wanted more than 0", frame_time_s));
}

std::vector<SkeletonPose> PoseGrid::Add(double time_s, const std::optional<SkeletonPose>& pose) {
  const bool goes_on = !has_time_ || (time_s > last_s_ && time_s - last_s_ <= kLongestGap_s);
  if (!std::isfinite(time_s) || !goes_on)
    throw InputError(
        fmt::format("found a frame at {} s behind one at {} s, wanted times that go "
                    "on by at most {} s",
                    time_s, last_s_, kLongestGap_s));
  if (!held_) first_s_ = time_s;
  std::vector<SkeletonPose> frames;
  if (!held_) held_ = pose;
  const double near_s = kSameTime * frame_time_s_;
  for (; held_; ++num_frames_) {
    const double now_s = first_s_ + static_cast<double>(num_frames_) * frame_time_s_;
    if (now_s > time_s + near_s) break;
    if (pose && now_s > time_s - near_s)
      frames.push_back(*pose);
    else if (pose && is_last_known_ && now_s > last_s_)
      frames.push_back(
          PoseBetween(skeleton_, *held_, *pose, (now_s - last_s_) / (time_s - last_s_)));
    else
      frames.push_back(*held_);
  }
  if (pose) held_ = pose;
  is_last_known_ = pose.has_value();
  last_s_ = time_s;
  has_time_ = true;
  return frames;
}

}  // namespace poselift
