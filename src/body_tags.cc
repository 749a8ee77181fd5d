// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/body_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/input_error.h"
#include "src/joints.h"

namespace poselift {
namespace {

constexpr double kFacingSigma_rad = 0.3;

// At rest, where bones have the world's axes: x to the left, y up, z to the front.
Eigen::Vector3d Direction(TagFacing faces) {
  switch (faces) {
    case TagFacing::kFront:
      return Eigen::Vector3d::UnitZ();
    case TagFacing::kBack:
      return -Eigen::Vector3d::UnitZ();
    case TagFacing::kLeft:
      return Eigen::Vector3d::UnitX();
    case TagFacing::kRight:
      return -Eigen::Vector3d::UnitX();
    case TagFacing::kUp:
      break;
  }
  return Eigen::Vector3d::UnitY();
}

// A print has no upright along what it faces: then nothing.
std::optional<Eigen::Matrix3d> BoneFromTag(const Bone& bone, TagFacing faces) {
  constexpr double kLeastAcross = 0.3;
  const Eigen::Vector3d along = bone.tip_m.normalized();  // 0 of the pelvis
  const bool is_arm = std::abs(along.x()) > 0.8;          // level at rest
  const bool is_limb = !along.isZero() && along.y() < 0.5;
  Eigen::Vector3d outward = Direction(faces), down = -Eigen::Vector3d::UnitY();
  if (is_arm) outward = Eigen::Quaterniond::FromTwoVectors(down, along) * outward;
  if (is_limb) down = along;
  const Eigen::Vector3d across = outward - outward.dot(down) * down;
  if (across.norm() < kLeastAcross) return std::nullopt;
  Eigen::Matrix3d bone_from_tag;
  bone_from_tag.col(1) = down;
  bone_from_tag.col(2) = -across.normalized();
  bone_from_tag.col(0) = down.cross(bone_from_tag.col(2));
  return bone_from_tag;
}

}  // namespace

const BodyTag* BodyTags::Find(int id) const {
  const auto found =
      std::find_if(tags.begin(), tags.end(), [&](const BodyTag& tag) { return tag.id == id; });
  return found == tags.end() ? nullptr : &*found;
}

BodyTags OnBones(BodyTags tags, const Skeleton& skeleton) {
  for (BodyTag& tag : tags.tags) {
    if (tag.on_bone || !tag.on_joint || !tag.on_joint->faces) continue;
    const auto joint = FindJoint(tag.on_joint->joint);
    if (!joint) continue;
    const Bone& bone = skeleton.bones.at(static_cast<size_t>(*joint));
    const auto rotation = BoneFromTag(bone, *tag.on_joint->faces);
    if (!rotation)
      throw InputError(fmt::format(
          "tag {}: found that it faces along the bone to {}, wanted across: front, back, left or "
          "right, and up on a foot",
          tag.id, tag.on_joint->joint));
    tag.on_bone = TagOnBone{
        .bone = bone.name, .sigma_m = tag.on_joint->sigma_m, .sigma_rad = kFacingSigma_rad};
    tag.on_bone->bone_from_tag.linear() = *rotation;
    tag.on_bone->bone_from_tag.translation() =
        bone.tip_m - tag.on_bone->bone_from_tag.linear() * tag.on_joint->joint_in_tag_m;
    tag.on_joint.reset();
  }
  return tags;
}

}  // namespace poselift
