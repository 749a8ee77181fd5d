// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/resample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kDigitsOfFiles = 1e-3;
constexpr double kWidestStep = 2.0;  // in frame times; wider is a gap

std::vector<bool> AreRotations(const Skeleton& skeleton) {
  std::vector<bool> are_rotations;
  for (const Bone& bone : skeleton.bones)
    for (const Dof& dof : bone.dofs) are_rotations.push_back(dof.IsRotation());
  return are_rotations;
}

SkeletonPose Between(const SkeletonPose& a, const SkeletonPose& b, double part,
                     const std::vector<bool>& are_rotations) {
  SkeletonPose pose;
  pose.root_in_world_m = (1.0 - part) * a.root_in_world_m + part * b.root_in_world_m;
  pose.world_from_root = a.world_from_root.slerp(part, b.world_from_root);
  pose.dofs = b.dofs - a.dofs;
  for (Eigen::Index d = 0; d < pose.dofs.size(); ++d)
    if (are_rotations[d]) pose.dofs[d] = std::remainder(pose.dofs[d], 2.0 * std::numbers::pi);
  pose.dofs = a.dofs + part * pose.dofs;
  return pose;
}

}  // namespace

Motion Resample(const Motion& motion, double frame_time_s) {
  if (!(frame_time_s > 0.0) || !(motion.frame_time_s > 0.0))
    throw InputError(fmt::format("found a frame time of {} s (of {} s), wanted more than 0",
                                 frame_time_s, motion.frame_time_s));
  const std::vector<bool> are_rotations = AreRotations(motion.skeleton);
  double step = frame_time_s / motion.frame_time_s;  // in old frames
  if (std::round(step) >= 1.0 && std::abs(step - std::round(step)) < kDigitsOfFiles)
    step = std::round(step);
  Motion resampled{motion.skeleton, frame_time_s, {}};
  const auto last = static_cast<double>(motion.frames.size()) - 1.0;
  for (size_t i = 0; static_cast<double>(i) * step <= last; ++i) {
    const double place = static_cast<double>(i) * step;
    const auto before = static_cast<size_t>(place);
    const double part = place - static_cast<double>(before);
    resampled.frames.push_back(
        part > 0.0 ? Between(motion.frames[before], motion.frames[before + 1], part, are_rotations)
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
  const std::vector<bool> are_rotations = AreRotations(skeleton);
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
          Between(poses[before], poses[after], since_s / step_s, are_rotations));
  }
  return resampled;
}

}  // namespace poselift
