// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/studio.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/input_error.h"
#include "src/level_camera.h"
#include "src/pose_between.h"

namespace poselift::testing {
namespace {

void CheckFrames(const Motion& motion) {
  if (motion.frames.empty()) throw InputError("found a motion without frames");
}

// Half a turn about the vertical and more, so that y stays up and z looks this way.
Eigen::Quaterniond Looking(const Eigen::Vector3d& direction) {
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(std::atan2(direction.x(), direction.z()), Eigen::Vector3d::UnitY()));
}

}  // namespace

BodyRenderer::PoseAt PosesOver(Motion motion) {
  CheckFrames(motion);
  return [motion = std::move(motion)](double time_s) {
    const auto last = static_cast<double>(motion.frames.size()) - 1.0;
    const double place = std::clamp(time_s / motion.frame_time_s, 0.0, last);
    const auto before = static_cast<size_t>(place);
    const size_t after = std::min(before + 1, motion.frames.size() - 1);
    return PoseBetween(motion.skeleton, motion.frames[before], motion.frames[after],
                       place - static_cast<double>(before));
  };
}

Motion OnTheSpot(Motion motion) {
  const int frames = static_cast<int>(motion.frames.size());
  const int half_second = static_cast<int>(std::lround(0.5 / motion.frame_time_s));
  std::vector<Eigen::Vector3d> path_m;
  for (int t = 0; t < frames; ++t) {
    // As many on both sides, so that a straight path stays one up to its ends.
    const int half = std::min({half_second, t, frames - 1 - t});
    Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
    for (int k = t - half; k <= t + half; ++k) sum_m += motion.frames[k].root_in_world_m;
    path_m.push_back(sum_m / (2 * half + 1));
  }
  for (int t = 0; t < frames; ++t)
    motion.frames[t].root_in_world_m -= Eigen::Vector3d(path_m[t].x(), 0.0, path_m[t].z());
  return motion;
}

Camera Webcam(double focal_px) {
  return {.width_px = 1280,
          .height_px = 720,
          .fx_px = focal_px,
          .fy_px = focal_px,
          .cx_px = 643,
          .cy_px = 356,
          .distortion = {.k1 = -0.06, .k2 = 0.03, .p1 = 0.0005, .p2 = -0.0003}};
}

PlacedCamera CameraBefore(const Motion& motion, double distance_m, double azimuth_rad,
                          const Camera& camera) {
  CheckFrames(motion);
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero(), ahead = Eigen::Vector3d::Zero();
  for (const SkeletonPose& pose : motion.frames) {
    middle_m += pose.root_in_world_m / static_cast<double>(motion.frames.size());
    ahead += pose.world_from_root * Eigen::Vector3d::UnitZ();
  }
  ahead.y() = 0.0;
  const Eigen::Vector3d to_camera =
      Eigen::AngleAxisd(azimuth_rad, Eigen::Vector3d::UnitY()) * ahead.normalized();
  Eigen::Isometry3d world_from_cam = Eigen::Isometry3d::Identity();
  world_from_cam.linear() = (Looking(to_camera) * kLevelFromCam).matrix();
  world_from_cam.translation() = middle_m + distance_m * to_camera;
  return {camera, world_from_cam.inverse()};
}

}  // namespace poselift::testing
