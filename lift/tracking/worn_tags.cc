// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/worn_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src/input_error.h"
#include "src/joints.h"

namespace poselift {
namespace {

constexpr double kLeastFacing = 0.2;  // cosine: a tag that is seen more from the side is lost

int BoneOf(const Skeleton& skeleton, const BodyTag& tag) {
  const auto bone = skeleton.FindBone(tag.on_bone->bone);
  if (!bone)
    throw InputError(fmt::format("tag {}: found the bone '{}', wanted one of the skeleton's",
                                 tag.id, tag.on_bone->bone));
  return *bone;
}

int JointOf(const BodyTag& tag) {
  const auto joint = FindJoint(tag.on_joint->joint);
  if (!joint)
    throw InputError(fmt::format("tag {}: found the joint '{}', wanted a name of a joint", tag.id,
                                 tag.on_joint->joint));
  return *joint;
}

}  // namespace

WornTags::WornTags(const Skeleton& skeleton, const BodyTags& tags, const Camera& camera,
                   const Eigen::Quaterniond& cam_from_world)
    : camera_(camera), view_{camera.fx_px, Eigen::Isometry3d(cam_from_world)} {
  for (const BodyTag& tag : OnBones(tags, skeleton).tags) {
    WornTag worn{.tag = tag};
    if (tag.on_bone) worn.bone = BoneOf(skeleton, tag);
    if (tag.on_joint) worn.joint = JointOf(tag);
    worn_.push_back(std::move(worn));
  }
}

Eigen::Isometry3d WornTags::CamFromBone(const BoneFrames& frames, int bone) const {
  return view_.cam_from_world * WorldFromBone(frames, bone);
}

std::vector<SeenTag> WornTags::Known(const std::vector<TagSighting>& sightings) const {
  std::vector<SeenTag> known;
  for (const TagSighting& sighting : sightings) {
    const auto worn = std::find_if(worn_.begin(), worn_.end(), [&](const WornTag& candidate) {
      return candidate.tag.id == sighting.detection.id;
    });
    if (worn == worn_.end()) continue;
    const SeenTag seen{&*worn, &sighting,
                       CornersWithoutLens(camera_, sighting.detection.corners_px)};
    if (seen.corners_px.allFinite()) known.push_back(seen);
  }
  return known;
}

std::vector<TagDetection> WornTags::Project(const BoneFrames& frames) const {
  std::vector<TagDetection> projected;
  for (const WornTag& worn : worn_) {
    if (worn.bone < 0) continue;
    const Eigen::Isometry3d cam_from_tag =
        CamFromBone(frames, worn.bone) * worn.tag.on_bone->bone_from_tag;
    const Eigen::Vector3d into_tag = cam_from_tag.linear().col(2);
    if (into_tag.dot(cam_from_tag.translation().normalized()) < kLeastFacing) continue;
    TagDetection tag{.id = worn.tag.id};
    const Eigen::Matrix<double, 3, 4> corners_m = cam_from_tag * TagCorners_m(worn.tag.size_m);
    for (int i = 0; i < 4; ++i) tag.corners_px.col(i) = camera_.Project(corners_m.col(i));
    tag.centre_px = tag.corners_px.rowwise().mean();
    const bool inside = tag.centre_px.x() >= 0.0 && tag.centre_px.x() < camera_.width_px &&
                        tag.centre_px.y() >= 0.0 && tag.centre_px.y() < camera_.height_px;
    if (tag.corners_px.allFinite() && inside) projected.push_back(tag);
  }
  return projected;
}

}  // namespace poselift
