// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "lift/lift_photo.h"
#include "lift/temporal/motion_codebook.h"
#include "lift/tracking/tag_fit.h"
#include "src/motion.h"
#include "src/testing/body_renderer.h"

namespace poselift::cli {

// What a rendered person wears.
enum class TagsWorn {
  kFront,   // 13 tags
  kAround,  // 36 tags on all sides
  kPrinted  // the 16 of `tags print`, which say what joint is where, and no more
};

// Captured motions rendered with tags on the body, then detected and tracked like any video.
struct TrackExperimentOptions {
  double distance_m = 3.0;
  double focal_px = 900.0;  // at 1280 x 720
  double tag_size_m = 0.08;
  TagsWorn worn = TagsWorn::kFront;
  double exposure_s = 1.0 / 120.0;
  double noise_grey_levels = 3.0;
  // How far off tags sit from where the tags file says (of the printed set: from where it
  // means them), before it is fitted: standard deviations of each coordinate.
  double misplaced_m = 0.015, misplaced_rad = 0.1;
  double fov_deg = 60.0;  // that a camera is taken for when nobody calibrated it
  uint64_t seed = 1;
};

// A motion as its video shows it, and the truth.
struct TaggedVideo {
  std::vector<cv::Mat> grey;
  std::vector<testing::FrameTruth> truth;
  std::vector<std::vector<TagDetection>> detections;  // in whole frames
  Camera camera;
  double frame_time_s = 0.0;
};

// How far a track is from the truth, over the frames with a pose.
struct TrackErrors {
  int num_frames = 0, num_unknown = 0;
  double visible_mm = 0.0;  // mean over the joints at the ends of bones whose tags are seen
  double all_mm = 0.0;      // over all 23, relative to the pelvis both
  double elbows_deg = 0.0,
         knees_deg = 0.0;       // RMS of flexion, where tags of both bones are seen; NaN: never
  int num_flips = 0;            // frames in which a seen knee or elbow is 15 cm off or more
  double sure_share = 0.0;      // of all joints: within twice their sigma of the truth
  double detected_share = 0.0;  // of tags that are turned by less than 60 degrees, not hidden
};

// Tags as they sit on a person, and as the tags file says it before it is fitted.
struct Dress {
  BodyTags worn, said;
};
Dress DressFor(const Skeleton& skeleton, const TrackExperimentOptions& options);

// The same of what is detected in whole frames.
double WholeFramesShare(const TaggedVideo& video);

TaggedVideo RenderTagged(const Motion& motion, const BodyTags& worn,
                         const TrackExperimentOptions& options, const ProgressFn& progress);

// The frames of the videos one after the other.
std::vector<SightedFrame> SightFrames(const std::vector<const TaggedVideo*>& videos,
                                      const BodyTags& tags, const Camera& camera);

// By TagSession, as `track` does. depth_sigma: TagSigmas.
TrackErrors TrackVideo(const TaggedVideo& video, const Skeleton& captured, const BodyTags& worn,
                       const BodyTags& tags, const Camera& camera, const PhotoLifter& lifter,
                       const std::shared_ptr<const MotionCodebook>& codebook, double depth_sigma);

}  // namespace poselift::cli
