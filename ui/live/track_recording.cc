// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/track_recording.h"

#include <cmath>
#include <string>
#include <system_error>
#include <vector>

#include "lift/normalize.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/joint_angles.h"
#include "src/motion.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

const fs::path& Made(const fs::path& dir) {
  std::error_code error;
  fs::create_directories(dir, error);
  if (error) throw InputError(dir.string(), "cannot be made a folder: " + error.message());
  return dir;
}

std::vector<std::string> AngleNames() {
  std::vector<std::string> names;
  for (const JointAngle& angle : JointAngles()) names.push_back(angle.name);
  return names;
}

// So that what reads the poses takes the person's bones, not the standard ones.
std::vector<PersonBones> BodyOf(const Skeleton& skeleton) {
  return {{0, BoneLengths(skeleton), Eigen::VectorXd::Zero(kNumJoints)}};
}

double LowestJoint_m(const Skeleton& skeleton, const SkeletonPose& pose) {
  double lowest_m = HUGE_VAL;
  const Pose3 joints_m = JointPositions(skeleton, pose);
  for (const double height_m : joints_m.row(1)) lowest_m = std::fmin(lowest_m, height_m);
  return lowest_m;
}

}  // namespace

TrackRecording::TrackRecording(const fs::path& dir, const Skeleton& skeleton, double frame_time_s,
                               std::string_view source)
    : skeleton_(skeleton),
      poses_(Made(dir) / "poses.json", BodyOf(skeleton), source),
      angles_(dir / "angles.csv", &PersonPose::angles_deg, AngleNames()),
      sigmas_(dir / "angles_sigma.csv", &PersonPose::angles_sigma_deg, AngleNames()),
      bvh_(dir / "poses.bvh", skeleton, frame_time_s),
      grid_(skeleton, frame_time_s) {}

void TrackRecording::Add(const FramePoses& frame, const std::optional<SkeletonPose>& pose_in_world,
                         double time_s) {
  for (const SkeletonPose& pose : grid_.Add(time_s, OnFloor(pose_in_world))) bvh_.Add(pose);
  poses_.Add(frame);
  angles_.Add(frame);
  sigmas_.Add(frame);
}

std::optional<SkeletonPose> TrackRecording::OnFloor(std::optional<SkeletonPose> pose_in_world) {
  if (!pose_in_world || !IsKnown(*pose_in_world)) return std::nullopt;
  if (!origin_in_world_m_) {
    origin_in_world_m_ = pose_in_world->root_in_world_m;
    origin_in_world_m_->y() = LowestJoint_m(skeleton_, *pose_in_world);
  }
  pose_in_world->root_in_world_m -= *origin_in_world_m_;
  return pose_in_world;
}

void TrackRecording::Close() {
  poses_.Close();
  angles_.Close();
  sigmas_.Close();
  bvh_.Close();
}

}  // namespace poselift
