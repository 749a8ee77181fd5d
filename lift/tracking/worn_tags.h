// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lift/tracking/tag_cost.h"
#include "src/body_tags.h"
#include "src/camera.h"
#include "src/forward_kinematics.h"
#include "src/tag_detection.h"

namespace poselift {

// A tag that a person wears: on a bone, or by a joint of the skeleton.
struct WornTag {
  BodyTag tag;
  int bone = -1;   // tag.on_bone
  int joint = -1;  // tag.on_joint
};

// One that a picture shows.
struct SeenTag {
  const WornTag* worn = nullptr;
  const TagSighting* sighting = nullptr;
  TagCorners corners_px;  // CornersWithoutLens
};

// The tags of a person before a camera, which looks into a world of y up and stands at its
// origin.
class WornTags {
 public:
  // Tags by a joint that say what they face count as on a bone (OnBones). Throws InputError for
  // tags on bones or joints that the skeleton does not have.
  WornTags(const Skeleton& skeleton, const BodyTags& tags, const Camera& camera,
           const Eigen::Quaterniond& cam_from_world);

  const TagView& view() const { return view_; }
  Eigen::Isometry3d CamFromBone(const BoneFrames& frames, int bone) const;

  // Those of them that are this person's; they point into `sightings` and into this.
  std::vector<SeenTag> Known(const std::vector<TagSighting>& sightings) const;

  // Where the tags on bones are seen in a pose: ids and corners. None that turn away or leave
  // the picture.
  std::vector<TagDetection> Project(const BoneFrames& frames) const;

 private:
  Camera camera_;
  TagView view_;
  std::vector<WornTag> worn_;
};

}  // namespace poselift
