// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/live_view.h"

#include <algorithm>
#include <string>

#include "src/joints.h"

namespace poselift {
namespace {

// The joint that the tag's bone ends at; nothing for bones beyond the 23 joints.
std::optional<int> JointOf(const BodyTag& tag) {
  if (tag.on_joint) return FindJoint(tag.on_joint->joint);
  const auto found = std::ranges::find(Joints(), tag.on_bone->bone, &JointInfo::cmu_bone);
  if (found == Joints().end()) return std::nullopt;
  return static_cast<int>(found - Joints().begin());
}

}  // namespace

Eigen::Matrix2Xd LivePose::JointsInPicture_px() const {
  Eigen::Matrix2Xd joints_px(2, joints_in_cam_m.cols());
  for (Eigen::Index j = 0; j < joints_px.cols(); ++j)
    joints_px.col(j) = camera.Project(joints_in_cam_m.col(j) + pelvis_in_cam_m);
  return joints_px;
}

std::optional<LivePose> LivePoseOf(const PersonPose& person, const BodyTags& tags,
                                   const Camera& camera, const Eigen::Vector3d& up_in_cam) {
  if (!person.joints_in_cam_m.allFinite() || !person.pelvis_in_cam_m.allFinite())
    return std::nullopt;
  LivePose pose{camera, person.joints_in_cam_m, person.pelvis_in_cam_m, up_in_cam};
  for (const PoseTag& seen : person.tags) {
    const BodyTag* const tag = tags.Find(seen.id);
    const std::optional<int> joint = tag && seen.believed ? JointOf(*tag) : std::nullopt;
    if (!joint) continue;
    pose.is_seen[static_cast<size_t>(*joint)] = true;
    const int before = Joints()[static_cast<size_t>(*joint)].parent;
    pose.is_seen[static_cast<size_t>(std::max(0, before))] = true;
  }
  return pose;
}

std::vector<LandmarkLabel> LabelsOf(const LivePose& pose, const Layout& layout) {
  std::vector<LandmarkLabel> labels;
  for (const Landmark& landmark : layout.landmarks) {
    if (landmark.parts.empty()) continue;
    const Eigen::Vector2d x_px = pose.camera.Project(
        SumOfJoints(landmark.parts, pose.joints_in_cam_m) + pose.pelvis_in_cam_m);
    const bool is_inside = x_px.x() >= -0.5 && x_px.x() <= pose.camera.width_px - 0.5 &&
                           x_px.y() >= -0.5 && x_px.y() <= pose.camera.height_px - 0.5;
    if (!is_inside) continue;  // NaN too
    const bool is_seen = std::ranges::all_of(landmark.parts, [&](const Landmark::Part& part) {
      return pose.is_seen[static_cast<size_t>(part.joint)];
    });
    labels.push_back({.name = std::string(landmark.name),
                      .x_px = x_px,
                      .state = is_seen ? LabelState::kVisible : LabelState::kOccluded});
  }
  return labels;
}

}  // namespace poselift
