// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Bends a one-joint arm by 90 degrees and says where its tip is: exit 0 when
// that is (1, 0.5, 0). Uses both libraries of the installed package.
#include <cstdio>

#include "lift/normalize.h"
#include "src/forward_kinematics.h"
#include "src/units.h"

int main() {
  using namespace poselift;
  Skeleton arm;
  arm.bones = {{.name = "root"},
               {.name = "upper", .parent = 0, .tip_m = {1, 0, 0}},
               {.name = "lower",
                .parent = 1,
                .offset_m = {1, 0, 0},
                .tip_m = {0.5, 0, 0},
                .dofs = {{Dof::Kind::kRz}}}};
  SkeletonPose pose = SkeletonPose::Rest(arm);
  pose.dofs << 90 * kRadFromDeg;
  BoneFrames frames;
  ForwardKinematics(arm, pose, &frames);
  const Eigen::Vector3d tip_in_world_m = frames.tip_in_world_m.col(2);
  std::printf("tip at %.3f %.3f %.3f\n", tip_in_world_m.x(), tip_in_world_m.y(),
              tip_in_world_m.z());

  const Pose3 collapsed = Pose3::Zero(3, kNumJoints);
  const Pose3 normalized = NormalizePose(collapsed, Eigen::VectorXd::Ones(kNumJoints));
  const bool right = (tip_in_world_m - Eigen::Vector3d(1, 0.5, 0)).norm() < 1e-12 &&
                     normalized.col(joint::kLeftHip).norm() == 1.0;
  return right ? 0 : 1;
}
