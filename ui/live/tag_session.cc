// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/tag_session.h"

#include <utility>

#include "calib/tag_pose.h"
#include "lift/poses_to_motion.h"
#include "lift/tracking/person_skeleton.h"

namespace poselift {
namespace {

// The ids of the person's tags alone are looked for.
TagSearchOptions ForPerson(TagSearchOptions options, const BodyTags& tags) {
  options.detector.known_ids.clear();
  for (const BodyTag& tag : tags.tags) options.detector.known_ids.push_back(tag.id);
  return options;
}

}  // namespace

TagSession::TagSession(const BodyTags& tags, const Camera& camera, const PhotoLifter& lifter,
                       std::shared_ptr<const MotionCodebook> codebook,
                       const TagSessionOptions& options)
    : tags_(tags),
      camera_(camera),
      skeleton_(PersonSkeleton(lifter.dictionary().skeleton, tags)),
      upright_(OnBones(tags, skeleton_), skeleton_, options.cam_from_world),
      search_(TagFamily(tags.family), ForPerson(options.search, tags)),
      tracker_(skeleton_, tags, camera, options.cam_from_world, lifter, std::move(codebook),
               options.tracker),
      person_(skeleton_, camera, options.cam_from_world) {}

void TagSession::Add(const VideoFrame& frame) {
  std::map<int, TagSearch::Corners> predicted_px;
  for (const TagDetection& tag : tracker_.Expected(frame.time_s))
    predicted_px.emplace(tag.id, tag.corners_px);
  std::vector<TagSighting> seen =
      SightTags(search_.Detect(frame.grey, predicted_px), tags_, camera_);
  upright_.PutFirst(&seen);
  tracker_.Add(frame.time_s, seen);
  Waiting& waiting = waiting_.emplace_back(Waiting{frame.time_s, frame.monotonic_s, {}});
  for (const TagSighting& tag : seen) waiting.tags.push_back(tag.detection);
}

std::optional<TagSession::Tracked> TagSession::Take() {
  const auto frame = tracker_.Take();
  if (!frame) return std::nullopt;
  Waiting& source = waiting_.front();
  Tracked tracked{.monotonic_s = source.monotonic_s, .tags = std::move(source.tags)};
  for (const TagDetection& tag : tracked.tags) tracked.tag_ids.push_back(tag.id);
  tracked.poses.time_s = source.time_s;
  waiting_.pop_front();
  tracked.poses.people.push_back(person_.Convert(*frame));
  if (frame->body.kind != SmoothedFrame::Kind::kNotKnown) tracked.pose = frame->body.pose;
  return tracked;
}

std::vector<TagSighting> SightTags(const std::vector<TagDetection>& detections,
                                   const BodyTags& tags, const Camera& camera) {
  std::vector<TagSighting> sightings;
  for (const TagDetection& detection : detections) {
    const BodyTag* worn = tags.Find(detection.id);
    if (!worn) continue;
    TagPoses found = FindTagPoses(camera, detection.corners_px, worn->size_m);
    sightings.push_back({detection, std::move(found.poses), found.is_ambiguous});
  }
  return sightings;
}

}  // namespace poselift
