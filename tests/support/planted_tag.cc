// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/planted_tag.h"

#include "src/forward_kinematics.h"

namespace poselift::testing {

ObservedBonePose PlantTag(const Skeleton& skeleton, const SkeletonPose& pose,
                          const std::string& bone) {
  ObservedBonePose tag{.name = "tag of " + bone, .bone = bone, .sigma_m = 0.005, .sigma_rad = 0.01};
  tag.bone_from_tag = Eigen::Translation3d(0.05, -0.1, 0.02) *
                      Eigen::AngleAxisd(1.2, Eigen::Vector3d(1.0, -2.0, 0.5).normalized());
  BoneFrames frames;
  ForwardKinematics(skeleton, pose, &frames);
  tag.cam_from_tag = WorldFromBone(frames, *skeleton.FindBone(bone)) * tag.bone_from_tag;
  return tag;
}

}  // namespace poselift::testing
