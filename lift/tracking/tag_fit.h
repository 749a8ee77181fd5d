// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "lift/body_proportions.h"
#include "lift/tracking/tag_bundle.h"
#include "lift/tracking/tag_tracker.h"
#include "src/progress.h"

namespace poselift {

// What was found about a tag.
struct TagFitRow {
  int id = 0;
  int num_frames = 0;     // that it was adjusted in; 0: never seen, it stays as it was
  double rms_px = 0.0;    // of its corners
  double moved_mm = 0.0;  // from where it was said to be
  double turned_deg = 0.0;
  double leaned_deg = 0.0;  // of that, its face: a paper may be worn any way up
};

struct TagFit {
  bool is_usable = false;
  std::string message;  // why not
  BodyTags tags;        // on bones, all that were seen; with the lengths of the bones
  Skeleton skeleton;    // of these lengths
  BodyProportions proportions;
  Camera camera;             // with the lens that was found, if that was asked for
  double focal_sigma = 0.0;  // of the logarithm of its focal length
  std::vector<TagFitRow> rows;
  int num_frames = 0;  // adjusted
};

// Tracks the movement, adjusts it together (TagBundle), and again with what was found.
// said: where the tags are about; each on a bone, on a joint or both. Throws InputError as
// TagTracker does.
TagFit FitTags(const std::vector<SightedFrame>& frames, const BodyTags& said, const Camera& camera,
               const Eigen::Quaterniond& cam_from_world, const PhotoLifter& lifter,
               const std::shared_ptr<const MotionCodebook>& codebook,
               const TagFitOptions& options = {}, const ProgressFn& progress = {});

}  // namespace poselift
