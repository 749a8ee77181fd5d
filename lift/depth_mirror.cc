// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/depth_mirror.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lift/rotation.h"
#include "src/joints.h"

namespace poselift {
namespace {

constexpr std::array<Limb, 4> kLimbs = {Limb::kLeftLeg, Limb::kRightLeg, Limb::kLeftArm,
                                        Limb::kRightArm};

// How much farther the end of the bone is than its start.
double DepthOfBone_m(int end, const Pose3& joints_in_cam_m) {
  const int start = Joints()[static_cast<size_t>(end)].parent;
  return joints_in_cam_m(2, end) - joints_in_cam_m(2, start);
}

LabelHint HintOfBone(int end, bool towards) {
  LabelHint hint;
  hint.kind = towards ? LabelHint::Kind::kTowardsCamera : LabelHint::Kind::kAwayFromCamera;
  hint.joint = Joints()[static_cast<size_t>(end)].name;
  return hint;
}

bool IsAbout(const JointRelation& relation, std::span<const int> joints) {
  return std::any_of(relation.parts.begin(), relation.parts.end(), [&](const auto& part) {
    return std::find(joints.begin() + 1, joints.end(), part.joint) != joints.end();
  });
}

// With what hangs on the pivot mirrored about its depth.
Eigen::VectorXd MirroredFrom(std::span<const int> joints, Eigen::VectorXd depths_m) {
  const double pivot_m = depths_m[joints.front()];
  for (const int j : joints) depths_m[j] = 2.0 * pivot_m - depths_m[j];
  return depths_m;
}

}  // namespace

std::span<const int> JointsOfLimb(Limb limb) {
  switch (limb) {
    case Limb::kLeftLeg:
      return JointChains()[0].subspan(1);
    case Limb::kRightLeg:
      return JointChains()[1].subspan(1);
    case Limb::kLeftArm:
      return JointChains()[3].subspan(1);
    case Limb::kRightArm:
      break;
  }
  return JointChains()[4].subspan(1);
}

std::vector<DepthMirror> MirrorsInDepth(const std::vector<JointRelation>& relations,
                                        const Pose3& joints_in_cam_m) {
  std::vector<const JointRelation*> broken;
  for (const JointRelation& relation : relations)
    if (relation.axis_in_cam.z() != 0.0 && std::abs(relation.Residual(joints_in_cam_m)) > 1.0)
      broken.push_back(&relation);
  std::vector<DepthMirror> mirrors;
  if (broken.empty()) return mirrors;
  const Eigen::VectorXd depths_m =
      (joints_in_cam_m.row(2).array() - joints_in_cam_m(2, joint::kPelvis)).transpose();
  for (const Limb limb : kLimbs) {
    const std::span<const int> joints = JointsOfLimb(limb);
    if (std::none_of(broken.begin(), broken.end(),
                     [&](const JointRelation* relation) { return IsAbout(*relation, joints); }))
      continue;
    mirrors.push_back({MirroredFrom(joints, depths_m)});
    mirrors.push_back({MirroredFrom(joints.subspan(1), depths_m)});
  }
  mirrors.push_back({-depths_m, true});
  return mirrors;
}

Eigen::Vector3d MirroredInDepth(const Eigen::Vector3d& tau_rad) {
  // Before the body and in it, so that it stays a rotation: across and up are mirrored,
  // forwards is what they make of it.
  const Eigen::Vector3d depth(1.0, 1.0, -1.0);
  return TauFromRotation(depth.asDiagonal() * CamFromBody(tau_rad) * depth.asDiagonal());
}

std::vector<LabelHint> HintsToFlip(Limb limb, const Pose3& joints_in_cam_m) {
  std::vector<LabelHint> hints;
  for (const int end : JointsOfLimb(limb).subspan(1, 2)) {
    const double depth_m = DepthOfBone_m(end, joints_in_cam_m);
    if (std::abs(depth_m) >= kLeastFlip_m) hints.push_back(HintOfBone(end, depth_m > 0.0));
  }
  return hints;
}

std::vector<LabelHint> HintsToChoose(const Pose3& wanted_in_cam_m, const Pose3& other_in_cam_m) {
  std::vector<LabelHint> hints;
  const auto add = [&](int end) {
    const double wanted_m = DepthOfBone_m(end, wanted_in_cam_m);
    const double other_m = DepthOfBone_m(end, other_in_cam_m);
    if (std::abs(wanted_m) >= kLeastFlip_m && wanted_m * other_m < 0.0)
      hints.push_back(HintOfBone(end, wanted_m < 0.0));
  };
  for (const Limb limb : kLimbs)
    for (const int end : JointsOfLimb(limb).subspan(1, 2)) add(end);
  // Which way the body faces shows in the shoulders and hips.
  for (const int end : {joint::kLeftHip, joint::kLeftShoulder, joint::kThorax, joint::kHeadTop})
    add(end);
  return hints;
}

}  // namespace poselift
