// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "src/body_tags.h"
#include "src/skeleton.h"

namespace poselift::testing {

struct TagPlacementOptions {
  double size_m = 0.08;
  // Edge of the paper by the size of the tag: that of tag36h11 with its white border.
  double paper_per_size = 10.0 / 8.0;
  double gap_m = 0.004;  // between paper and body
  // Off: what a camera before a person who stands or walks sees, 13 tags. On: around
  // the trunk, the head and the limbs as well, 36 tags; the first 13 are the same.
  bool around = false;
  int first_id = 0;

  std::string Validate() const;
};

// A person dressed in tags: flat on pelvis, chest, forehead, arms, thighs, shins and
// feet, upright for one who stands with hanging arms, just outside of BodyAround.
// Throws InputError when the skeleton lacks a bone of CMU's.
BodyTags DefaultTagPlacement(const Skeleton& skeleton, const TagPlacementOptions& options = {});

// Tags on bones, moved along their normals to just outside of BodyAround; of the options
// paper and gap count. Throws InputError for a tag on no bone of the skeleton.
BodyTags OnSurface(BodyTags tags, const Skeleton& skeleton,
                   const TagPlacementOptions& options = {});

}  // namespace poselift::testing
