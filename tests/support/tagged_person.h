// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <random>
#include <vector>

#include "src/body_tags.h"
#include "src/camera.h"
#include "src/skeleton.h"
#include "src/tag_detection.h"

namespace poselift::testing {

// A person in tags before a level camera, as a detector would see the tags: those that face
// the camera, whatever stands between.
struct TaggedPerson {
  explicit TaggedPerson(const Skeleton& skeleton_in);

  // Standing 3 m before the camera, arms and legs swinging, turning a little: y up, the
  // camera at the origin.
  SkeletonPose PoseAt(double time_s) const;
  // With both poses of each tag, noise on its corners.
  std::vector<TagSighting> Sight(const SkeletonPose& pose, double noise_px,
                                 std::mt19937_64* rng) const;

  Skeleton skeleton;
  BodyTags worn;
  Camera camera;
};

}  // namespace poselift::testing
