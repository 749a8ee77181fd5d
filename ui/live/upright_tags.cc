// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/upright_tags.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "calib/tag_pose.h"
#include "src/forward_kinematics.h"

namespace poselift {
namespace {

constexpr std::array<std::string_view, 7> kTrunk = {"root",      "lowerback", "upperback", "thorax",
                                                    "lowerneck", "upperneck", "head"};

}  // namespace

UprightTags::UprightTags(const BodyTags& tags, const Skeleton& skeleton,
                         const Eigen::Quaterniond& cam_from_world)
    : down_in_cam_(cam_from_world * -Eigen::Vector3d::UnitY()) {
  SkeletonPose standing;
  standing.dofs = Eigen::VectorXd::Zero(skeleton.NumDofs());
  BoneFrames frames;
  ForwardKinematics(skeleton, standing, &frames);
  for (const BodyTag& tag : tags.tags) {
    if (!tag.on_bone || std::ranges::count(kTrunk, tag.on_bone->bone) == 0) continue;
    const auto bone = std::ranges::find(skeleton.bones, tag.on_bone->bone, &Bone::name);
    if (bone == skeleton.bones.end()) continue;
    const Eigen::Matrix3d& world_from_bone =
        frames.world_from_bone[static_cast<size_t>(bone - skeleton.bones.begin())];
    down_in_tag_[tag.id] =
        -(world_from_bone * tag.on_bone->bone_from_tag.linear()).row(1).transpose();
  }
}

void UprightTags::PutFirst(std::vector<TagSighting>* seen) const {
  for (TagSighting& tag : *seen) {
    const auto down = down_in_tag_.find(tag.detection.id);
    if (!tag.is_ambiguous || tag.poses.size() < 2 || down == down_in_tag_.end()) continue;
    const TagPoseHints hangs{
        .gravity = TagPoseHints::Gravity{.down_in_cam = down_in_cam_, .down_in_tag = down->second}};
    const size_t first = ChooseTagPose({tag.poses, true}, hangs).index;
    std::swap(tag.poses.front(), tag.poses[first]);
  }
}

}  // namespace poselift
