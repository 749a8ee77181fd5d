// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/tag_session.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <utility>

#include "lift/poses_to_motion.h"
#include "lift/tracking/person_skeleton.h"
#include "src/level_camera.h"

namespace poselift::cli {
namespace {

// The ids of the person's tags alone are looked for.
TagDetectorOptions ForPerson(TagDetectorOptions options, const BodyTags& tags) {
  options.known_ids.clear();
  for (const BodyTag& tag : tags.tags) options.known_ids.push_back(tag.id);
  return options;
}

}  // namespace

TagSession::TagSession(const BodyTags& tags, const Camera& camera, const PhotoLifter& lifter,
                       std::shared_ptr<const MotionCodebook> codebook,
                       const TagSessionOptions& options)
    : tags_(tags),
      camera_(camera),
      skeleton_(PersonSkeleton(lifter.dictionary().skeleton, tags)),
      detector_(TagFamily(tags.family), ForPerson(options.detector, tags)),
      tracker_(skeleton_, tags, camera, kLevelFromCam, lifter, std::move(codebook),
               options.tracker),
      person_(skeleton_, camera, kLevelFromCam) {}

void TagSession::Add(const VideoFrame& frame) {
  const std::vector<TagSighting> seen = SightTags(detector_.Detect(frame.grey), tags_, camera_);
  tracker_.Add(frame.time_s, seen);
  waiting_.push_back({frame.time_s, frame.monotonic_s, static_cast<int>(seen.size())});
}

std::optional<TagSession::Tracked> TagSession::Take() {
  const auto frame = tracker_.Take();
  if (!frame) return std::nullopt;
  const Waiting source = waiting_.front();
  waiting_.pop_front();
  Tracked tracked{.monotonic_s = source.monotonic_s, .num_tags = source.num_tags};
  tracked.poses.time_s = source.time_s;
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
    TagSighting sighting{detection, {}, false};
    std::vector<cv::Point3d> corners_m;
    std::vector<cv::Point2d> rays;
    const Eigen::Matrix<double, 3, 4> model = TagCorners_m(worn->size_m);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d ray = camera.Undistort(detection.corners_px.col(i));
      corners_m.emplace_back(model(0, i), -model(1, i), 0.0);
      rays.emplace_back(ray.x(), ray.y());
    }
    std::vector<cv::Mat> turns, shifts, errors;
    cv::Mat reprojection;
    cv::solvePnPGeneric(corners_m, rays, cv::Matx33d::eye(), cv::noArray(), turns, shifts, false,
                        cv::SOLVEPNP_IPPE_SQUARE, cv::noArray(), cv::noArray(), reprojection);
    for (size_t k = 0; k < turns.size(); ++k) {
      cv::Mat R;
      cv::Rodrigues(turns[k], R);
      TagPose pose;
      Eigen::Matrix3d rotation;
      cv::cv2eigen(R, rotation);
      // IPPE's square has y up.
      pose.cam_from_tag.linear() =
          rotation * Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal().toDenseMatrix();
      pose.cam_from_tag.translation() = Eigen::Vector3d(
          shifts[k].at<double>(0), shifts[k].at<double>(1), shifts[k].at<double>(2));
      const double depth_sigma = 0.3 * pose.cam_from_tag.translation().z() *
                                 pose.cam_from_tag.translation().z() /
                                 (camera.fx_px * worn->size_m);
      pose.covariance.setZero();
      pose.covariance.diagonal() << 1e-5, 1e-5, depth_sigma * depth_sigma, 0.02, 0.02, 0.001;
      pose.rms_px = camera.fx_px * reprojection.at<double>(static_cast<int>(k));
      sighting.poses.push_back(pose);
    }
    if (sighting.poses.size() == 2)
      sighting.is_ambiguous = sighting.poses[1].rms_px - sighting.poses[0].rms_px < 0.3;
    sightings.push_back(std::move(sighting));
  }
  return sightings;
}

}  // namespace poselift::cli
