// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "src/joint_relation.h"
#include "src/pose3.h"

namespace poselift {

// A picture shows no depth: of each limb, and of the whole body, it shows the mirror
// image z -> -z just as well.

enum class Limb { kLeftLeg, kRightLeg, kLeftArm, kRightArm };

// The joints of a limb from the hip or shoulder, which stays, to the end.
std::span<const int> JointsOfLimb(Limb limb);

// The depths of a pose's joints behind the pelvis, some of them mirrored.
struct DepthMirror {
  Eigen::VectorXd depths_m;  // 23
  bool whole_body = false;
};

// For a pose that does not meet all relations: of every limb that the broken ones are
// about the image from its first joint on and from its second, and that of the body.
std::vector<DepthMirror> MirrorsInDepth(const std::vector<JointRelation>& relations,
                                        const Pose3& joints_in_cam_m);

// The angles (lift/rotation.h) of the body's mirror image.
Eigen::Vector3d MirroredInDepth(const Eigen::Vector3d& tau_rad);

// Hints with which a limb goes the other way: of its two long bones, those that end at
// least this far before or behind their start. None when both lie in the picture's plane.
inline constexpr double kLeastFlip_m = 0.03;
std::vector<LabelHint> HintsToFlip(Limb limb, const Pose3& joints_in_cam_m);

// Hints with which `wanted` is chosen before `other`: of the long bones of limbs, of
// hip, shoulder, thorax and head, those that go towards the camera in one and away in the
// other, by at least kLeastFlip_m in what is wanted.
std::vector<LabelHint> HintsToChoose(const Pose3& wanted_in_cam_m, const Pose3& other_in_cam_m);

}  // namespace poselift
