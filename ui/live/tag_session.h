// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/tag_search.h"
#include "lift/tracking/tag_tracker.h"
#include "lift/tracking/tracked_person.h"
#include "src/io/frame_source.h"
#include "src/level_camera.h"
#include "src/poses.h"
#include "ui/live/upright_tags.h"

namespace poselift {

struct TagSessionOptions {
  TagSearchOptions search;
  TagTrackerOptions tracker;
  Eigen::Quaterniond cam_from_world = kLevelFromCam;  // a rotation
};

// The flow from pictures to poses of a person who wears tags: detected, posed, tracked.
class TagSession {
 public:
  struct Tracked {
    FramePoses poses;                  // of this person alone
    std::optional<SkeletonPose> pose;  // y up, the camera at the origin; nothing: not known
    double monotonic_s = 0.0;          // when the frame was taken, NaN of files
    std::vector<int> tag_ids;          // of the person's, in the frame
    std::vector<TagDetection> tags;    // the same, as the picture shows them
  };

  // lifter must outlive this. Throws InputError as TagDetector and
  // TagTracker do.
  TagSession(const BodyTags& tags, const Camera& camera, const PhotoLifter& lifter,
             std::shared_ptr<const MotionCodebook> codebook, const TagSessionOptions& options);

  // frame: with its grey picture.
  void Add(const VideoFrame& frame);
  void End() { tracker_.End(); }
  std::optional<Tracked> Take();

  const Skeleton& skeleton() const { return skeleton_; }
  const BodyTags& tags() const { return tags_; }
  const Camera& camera() const { return camera_; }

 private:
  struct Waiting {
    double time_s, monotonic_s;
    std::vector<TagDetection> tags;
  };

  BodyTags tags_;
  Camera camera_;
  Skeleton skeleton_;
  UprightTags upright_;
  TagSearch search_;
  TagTracker tracker_;
  TrackedPerson person_;
  std::deque<Waiting> waiting_;
};

// The tags in a picture, with the poses that explain their corners.
std::vector<TagSighting> SightTags(const std::vector<TagDetection>& detections,
                                   const BodyTags& tags, const Camera& camera);

}  // namespace poselift
