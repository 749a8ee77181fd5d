// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/skeleton.h"

namespace poselift {

// The tags that a person wears: the content of tags.toml. Frames and sizes of tags are
// those of tag_detection.h.

// Away from the body, while its wearer stands with hanging arms.
enum class TagFacing { kFront, kBack, kLeft, kRight, kUp };

// Where a tag sits, by a joint: a guess that needs no measuring but the depth of the flesh.
struct TagOnJoint {
  std::string joint;  // JointName
  Eigen::Vector3d joint_in_tag_m = Eigen::Vector3d::Zero();
  double sigma_m = 0.02;
  // If it is known the tag is taken for fixed to the bone that ends at the joint: the print
  // is upright on trunk and head, and runs along the bone to the joint on limbs.
  std::optional<TagFacing> faces;
};

// Where a tag sits, all of it: fixed to a bone, in the frame of Bone (skeleton.h).
struct TagOnBone {
  std::string bone;                                                 // of the CMU skeleton, "lfemur"
  Eigen::Isometry3d bone_from_tag = Eigen::Isometry3d::Identity();  // metres
  double sigma_m = 0.01;
  double sigma_rad = 0.1;
};

struct BodyTag {
  int id = 0;
  double size_m = 0.0;
  std::string name;  // for people; may be empty
  // At least one of them.
  std::optional<TagOnJoint> on_joint;
  std::optional<TagOnBone> on_bone;
};

struct BodyTags {
  std::string family = "tag36h11";
  std::vector<BodyTag> tags;  // ids differ
  // Of the person who wears them, by the joints at the bones' ends, where it was measured.
  std::vector<std::pair<std::string, double>> bone_lengths_m;

  const BodyTag* Find(int id) const;  // nullptr: not of this person
};

// Tags that say what they face, as they sit on the bones of a skeleton whose bones end at the
// 23 joints: about, some 17 degrees off. The others stay as they are. Throws InputError for a tag
// that faces along its bone.
BodyTags OnBones(BodyTags tags, const Skeleton& skeleton);

}  // namespace poselift
