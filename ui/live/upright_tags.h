// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <vector>

#include "src/body_tags.h"
#include "src/skeleton.h"
#include "src/tag_detection.h"

namespace poselift {

// Who is seen for the first time stands, about: of the two ways that a tag on trunk or head may
// lean where its corners do not tell (TagSighting::is_ambiguous), that in which it hangs so comes
// first (ChooseTagPose by gravity). Limbs may hang anyhow. Later the pose before and the body tell.
class UprightTags {
 public:
  UprightTags(const BodyTags& tags, const Skeleton& skeleton,
              const Eigen::Quaterniond& cam_from_world);
  void PutFirst(std::vector<TagSighting>* seen) const;

 private:
  Eigen::Vector3d down_in_cam_;
  std::map<int, Eigen::Vector3d> down_in_tag_;  // by id
};

}  // namespace poselift
