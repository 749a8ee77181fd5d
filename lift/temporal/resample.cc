// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/resample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "src/input_error.h"
#include "src/pose_between.h"

namespace poselift {
namespace {

constexpr double kDigitsOfFiles = 1e-3;
constexpr double kWidestStep = 2.0;  // in frame times; wider is a gap

}  // namespace

Motion Resample(const Motion& motion, double frame_time_s) {
  if (!(frame_time_s > 0.0) || !(motion.frame_time_s > 0.0))
    throw InputError(fmt::format("found a frame time of {} s (of {} s), wanted more than 0",
                                 frame_time_s, motion.frame_time_s));
  double step = frame_time_s / motion.frame_time_s;  // in old frames
  if (std::round(step) >= 1.0 && std::abs(step - std::round(step)) < kDigitsOfFiles)
    step = std::round(step);
  Motion resampled{motion.skeleton, frame_time_s, {}};
  const auto last = static_cast<double>(motion.frames.size()) - 1.0;
  for (size_t i = 0; static_cast<double>(i) * step <= last; ++i) {
    const double place = static_cast<double>(i) * step;
    const auto before = static_cast<size_t>(place);
    const double part = place - static_cast<double>(before);
    resampled.frames.push_back(part > 0.0 ? PoseBetween(motion.skeleton, motion.frames[before],
                                                        motion.frames[before + 1], part)
                                          : motion.frames[before]);
  }
  return resampled;
}

Motion ResampleUneven(const Skeleton& skeleton, const std::vector<SkeletonPose>& poses,
                      std::span<const double> times_s, double frame_time_s) {
  if (!(frame_time_s > 0.0))
    throw InputError(fmt::format("found a frame time of {} s, wanted more than 0", frame_time_s));
  if (poses.size() != times_s.size())
    throw std::invalid_argument("ResampleUneven: a time for each pose is wanted");
  Motion resampled{skeleton, frame_time_s, {}};
  if (poses.empty()) return resampled;
  size_t before = 0;
  for (size_t k = 0;; ++k) {
    const double now_s = times_s.front() + static_cast<double>(k) * frame_time_s;
    if (now_s > times_s.back() + kDigitsOfFiles * frame_time_s) break;
    while (before + 1 < times_s.size() && times_s[before + 1] <= now_s) ++before;
    const size_t after = std::min(before + 1, poses.size() - 1);
    const double step_s = times_s[after] - times_s[before];
    const double since_s = now_s - times_s[before];
    const double near_s = kDigitsOfFiles * frame_time_s;
    if (since_s <= near_s || after == before)
      resampled.frames.push_back(poses[before]);
    else if (step_s - since_s <= near_s)
      resampled.frames.push_back(poses[after]);
    else if (step_s > kWidestStep * frame_time_s || !IsKnown(poses[before]) ||
             !IsKnown(poses[after]))
      resampled.frames.push_back(UnknownPose(skeleton));
    else
      resampled.frames.push_back(
          PoseBetween(skeleton, poses[before], poses[after], since_s / step_s));
  }
  return resampled;
}

}  // namespace poselift
