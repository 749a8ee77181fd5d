// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/forward_kinematics.h"

#include <benchmark/benchmark.h>

namespace poselift {
namespace {

// A tree with the shape and the degrees of freedom of the trimmed CMU body:
// the cost does not depend on its lengths.
Skeleton Body() {
  Skeleton skeleton;
  for (int j = 0; j < kNumJoints; ++j) {
    Bone bone;
    bone.name = Joints()[j].cmu_bone;
    bone.parent = Joints()[j].parent;
    bone.tip_m = {0.0, 0.2, 0.1};
    if (j > 0) {
      bone.offset_m = skeleton.bones[bone.parent].tip_m;
      bone.rest_from_axis = Eigen::AngleAxisd(0.1 * j, Eigen::Vector3d::UnitZ()).matrix();
      // 40 of the joints in all, as TrimToJoints leaves.
      bone.dofs.assign(j <= 18 ? 2 : 1, {Dof::Kind::kRx});
      if (bone.dofs.size() == 2) bone.dofs[1].kind = Dof::Kind::kRz;
    }
    skeleton.bones.push_back(bone);
  }
  return skeleton;
}

void ForwardKinematicsBench(benchmark::State& state) {
  const Skeleton skeleton = Body();
  const JointSites sites = FindJointSites(skeleton);
  SkeletonPose pose = SkeletonPose::Rest(skeleton);
  pose.dofs.setConstant(0.3);
  BoneFrames frames;
  for (auto _ : state) {
    ForwardKinematics(skeleton, pose, &frames);
    Pose3 joints_in_world_m = JointPositions(sites, frames);
    benchmark::DoNotOptimize(joints_in_world_m.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ForwardKinematicsBench)->Name("forward_kinematics");

}  // namespace
}  // namespace poselift
