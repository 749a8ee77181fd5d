// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/new_pose.h"

#include <fmt/format.h>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/level_camera.h"
#include "ui/label/label_project.h"
#include "ui/label/pose_drag.h"
#include "ui/label/pose_handles.h"

namespace poselift {
namespace {

using namespace joint;  // NOLINT(google-build-using-namespace)

constexpr int kSide_px = 1000;

// At rest the CMU body stretches its arms out and stands astride.
Pose3 StandingInBody_m(const Skeleton& skeleton) {
  const Pose3 rest_m = JointPositions(skeleton, SkeletonPose::Rest(skeleton));
  Pose3 standing_m = rest_m;
  for (int j = 1; j < kNumJoints; ++j) {
    const int parent = Joints()[static_cast<size_t>(j)].parent;
    Eigen::Vector3d bone_m = rest_m.col(j) - rest_m.col(parent);
    const double out = rest_m(0, j) > 0.0 ? 1.0 : -1.0;
    const bool is_of_arm = HangsOn(j, kLeftShoulder) || HangsOn(j, kRightShoulder);
    if (is_of_arm)
      bone_m = bone_m.norm() * Eigen::Vector3d(0.2 * out, -1.0, 0.08).normalized();
    else if (j == kLeftKnee || j == kRightKnee || j == kLeftAnkle || j == kRightAnkle)
      bone_m = bone_m.norm() * Eigen::Vector3d(0.06 * out, -1.0, 0.0).normalized();
    standing_m.col(j) = standing_m.col(parent) + bone_m;
  }
  return standing_m;
}

}  // namespace

Labels NewPose(const Layout& layout, const Skeleton& skeleton) {
  const Pose3 in_cam_m = kLevelFromCam.toRotationMatrix() * StandingInBody_m(skeleton);
  PersonLabels person;
  person.hints = SoftPins(PoseHandles(layout), {}, in_cam_m, 1.0);
  FrameLabels frame{.width_px = kSide_px, .height_px = kSide_px, .time_s = 0.0, .frame = 0};
  frame.people.push_back(std::move(person));
  return {std::string(layout.name), {std::move(frame)}};
}

void CreatePoseFile(const std::filesystem::path& file, const std::string& layout,
                    const Skeleton& skeleton) {
  if (std::filesystem::exists(file)) return;
  const Layout* found = FindLayout(layout);
  if (!found)
    throw InputError(fmt::format("found no layout \"{}\", wanted one, such as body15", layout));
  PrepareFolderOf(file);
  CreateLabelsFile(file, NewPose(*found, skeleton));
}

}  // namespace poselift
