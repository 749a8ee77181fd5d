// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/body_tag_set.h"

#include <array>

#include "src/body_segments.h"

namespace poselift {
namespace {

// The arrow points up while the person stands with hanging arms, on hands and feet against
// the wrist and the shin. Then a tag's y runs down the body and its z into it.
struct Row {
  const char* name;
  double size_mm;
  const char* place;
  const char* joint;
  double below_mm, behind_mm, sigma_mm;  // of the joint, as seen from the tag
  TagFacing faces;
};

constexpr std::array kRows = {
    Row{"pelvis", 70, "on the belt, front middle", "pelvis", 0, 110, 40, TagFacing::kFront},
    Row{"chest", 70, "on the breastbone", "thorax", -110, 90, 40, TagFacing::kFront},
    Row{"back", 70, "between the shoulder blades", "thorax", -90, 110, 40, TagFacing::kBack},
    Row{"head", 70, "on the forehead", "head_top", -90, 90, 40, TagFacing::kFront},
    Row{"left_upper_arm", 70, "outside of the upper arm, middle", "left_elbow", 130, 50, 30,
        TagFacing::kLeft},
    Row{"right_upper_arm", 70, "outside of the upper arm, middle", "right_elbow", 130, 50, 30,
        TagFacing::kRight},
    Row{"left_forearm", 70, "back of the forearm, near the wrist", "left_wrist", 60, 30, 25,
        TagFacing::kLeft},
    Row{"right_forearm", 70, "back of the forearm, near the wrist", "right_wrist", 60, 30, 25,
        TagFacing::kRight},
    Row{"left_hand", 65, "back of the hand, arrow to the wrist", "left_hand", 10, 15, 30,
        TagFacing::kLeft},
    Row{"right_hand", 65, "back of the hand, arrow to the wrist", "right_hand", 10, 15, 30,
        TagFacing::kRight},
    Row{"left_thigh", 70, "front of the thigh, middle", "left_knee", 190, 65, 35,
        TagFacing::kFront},
    Row{"right_thigh", 70, "front of the thigh, middle", "right_knee", 190, 65, 35,
        TagFacing::kFront},
    Row{"left_shin", 70, "front of the shin, middle", "left_ankle", 190, 50, 30, TagFacing::kFront},
    Row{"right_shin", 70, "front of the shin, middle", "right_ankle", 190, 50, 30,
        TagFacing::kFront},
    Row{"left_foot", 65, "on the instep, arrow to the shin", "left_foot", 60, 35, 30,
        TagFacing::kUp},
    Row{"right_foot", 65, "on the instep, arrow to the shin", "right_foot", 60, 35, 30,
        TagFacing::kUp},
};

}  // namespace

BodyTags DefaultBodyTags() {
  BodyTags tags;
  for (const Row& row : kRows)
    tags.tags.push_back(
        {.id = static_cast<int>(tags.tags.size()),
         .size_m = 1e-3 * row.size_mm,
         .name = row.name,
         .on_joint = TagOnJoint{.joint = row.joint,
                                .joint_in_tag_m = {0.0, 1e-3 * row.below_mm, 1e-3 * row.behind_mm},
                                .sigma_m = 1e-3 * row.sigma_mm,
                                .faces = row.faces}});
  return tags;
}

std::vector<SheetTag> SheetTagsOf(const BodyTags& tags) {
  std::vector<SheetTag> sheet;
  for (const BodyTag& tag : tags.tags) {
    SheetTag printed{.id = tag.id, .size_m = tag.size_m, .name = tag.name};
    if (tag.on_joint) printed.name += (tag.name.empty() ? "" : ", ") + tag.on_joint->joint;
    if (tag.on_bone) printed.place = "on " + SegmentName(tag.on_bone->bone);
    for (const Row& row : kRows)
      if (tag.name == row.name) printed.place = row.place;
    sheet.push_back(std::move(printed));
  }
  return sheet;
}

}  // namespace poselift
