// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/tag_observation.h"

#include <cmath>
#include <string>

#include "src/joints.h"

namespace poselift {
namespace {

constexpr double kLeanUnknown_rad = 0.7;  // of a tag that may lean either way

ObservedPoint Point(int joint, const Eigen::Vector3d& x_in_cam_m, double variance_m2) {
  return {.name = std::string(Joints()[static_cast<size_t>(joint)].name),
          .parts = {{joint, 1.0}},
          .kind = ObservedPoint::Kind::k3D,
          .x = x_in_cam_m,
          .sigma = std::sqrt(variance_m2)};
}

void AddTag(const SeenTag& tag, const TagPose& pose, const Skeleton& skeleton,
            Observation* observation) {
  const double place_m2 = pose.covariance.bottomRightCorner<3, 3>().trace();
  const double lean_rad2 = pose.covariance.topLeftCorner<3, 3>().trace() +
                           (tag.sighting->is_ambiguous ? kLeanUnknown_rad * kLeanUnknown_rad : 0.0);
  if (tag.worn->bone < 0) {
    const TagOnJoint& mount = *tag.worn->tag.on_joint;
    observation->points.push_back(Point(
        tag.worn->joint, pose.cam_from_tag * mount.joint_in_tag_m,
        place_m2 + mount.sigma_m * mount.sigma_m + mount.joint_in_tag_m.squaredNorm() * lean_rad2));
    return;
  }
  const TagOnBone& mount = *tag.worn->tag.on_bone;
  const Eigen::Isometry3d cam_from_bone = pose.cam_from_tag * mount.bone_from_tag.inverse();
  const Bone& bone = skeleton.bones[static_cast<size_t>(tag.worn->bone)];
  const double rad2 = lean_rad2 + mount.sigma_rad * mount.sigma_rad;
  const auto add_end = [&](int joint, const Eigen::Vector3d& x_in_bone_m) {
    const double lever_m2 = (x_in_bone_m - mount.bone_from_tag.translation()).squaredNorm();
    observation->points.push_back(
        Point(joint, cam_from_bone * x_in_bone_m,
              place_m2 + mount.sigma_m * mount.sigma_m + lever_m2 * rad2));
  };
  add_end(tag.worn->bone, bone.tip_m);
  if (bone.parent >= 0) add_end(bone.parent, Eigen::Vector3d::Zero());
}

}  // namespace

Observation ObserveTags(const std::vector<SeenTag>& seen, const Skeleton& skeleton) {
  Observation observation;
  for (const SeenTag& tag : seen)
    if (!tag.sighting->poses.empty())
      AddTag(tag, tag.sighting->poses.front(), skeleton, &observation);
  return observation;
}

}  // namespace poselift
