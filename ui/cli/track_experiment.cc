// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/track_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

#include "calib/body_tag_set.h"
#include "calib/tag_detector.h"
#include "lift/normalize.h"
#include "src/joint_angles.h"
#include "src/testing/studio.h"
#include "src/testing/tag_placement.h"
#include "ui/live/tag_session.h"

namespace poselift::cli {
namespace {

constexpr double kFlip_m = 0.15;
constexpr double kWellSeen_rad = std::numbers::pi / 3.0;
constexpr double kWellSeenShare = 0.98;
constexpr double kSightedGap_s = 5.0;  // between videos that follow each other

bool IsWellSeen(const testing::TagTruth& tag) {
  return tag.visible_share > kWellSeenShare && tag.facing_rad < kWellSeen_rad;
}

// Of bones, by the joints at their ends: whether a tag of theirs is detected.
using SeenBones = std::array<bool, kNumJoints>;

SeenBones FindSeen(const BodyTags& worn, const std::vector<int>& tag_ids) {
  SeenBones seen{};
  for (const int id : tag_ids) {
    const BodyTag* tag = worn.Find(id);
    if (!tag || !tag->on_bone) continue;
    for (int j = 0; j < kNumJoints; ++j) {
      if (Joints()[static_cast<size_t>(j)].cmu_bone == tag->on_bone->bone)
        seen[static_cast<size_t>(j)] = true;
    }
  }
  return seen;
}

// At an end of a bone that is seen.
bool IsVisible(int joint, const SeenBones& seen) {
  if (seen[static_cast<size_t>(joint)]) return true;
  for (int j = 0; j < kNumJoints; ++j)
    if (seen[static_cast<size_t>(j)] && Joints()[static_cast<size_t>(j)].parent == joint)
      return true;
  return false;
}

// RMS of hinges, of which both bones are seen.
struct HingeSum {
  double deg2 = 0.0;
  int count = 0;

  void Add(double off_deg) {
    deg2 += off_deg * off_deg;
    ++count;
  }
  double Rms_deg() const { return count > 0 ? std::sqrt(deg2 / count) : std::nan(""); }
};

// Sums over frames, then TrackErrors.
class ErrorSums {
 public:
  explicit ErrorSums(const Skeleton& captured) : reader_(captured) {}

  void Add(const PersonPose& person, const testing::FrameTruth& truth, const SeenBones& seen) {
    ++errors_.num_frames;
    if (!person.joints_in_cam_m.allFinite()) {
      ++errors_.num_unknown;
      return;
    }
    const Pose3 true_m =
        truth.joints_in_cam_m.colwise() - truth.joints_in_cam_m.col(joint::kPelvis);
    const Eigen::RowVectorXd off_m = (person.joints_in_cam_m - true_m).colwise().norm();
    for (int j = 0; j < kNumJoints; ++j) {
      all_m_ += off_m[j];
      num_sure_ += off_m[j] <= 2.0 * person.joints_sigma_m[j];
      if (!IsVisible(j, seen)) continue;
      visible_m_ += off_m[j];
      ++num_visible_;
    }
    const auto flipped = [&](int j) { return IsVisible(j, seen) && off_m[j] > kFlip_m; };
    errors_.num_flips += flipped(joint::kLeftKnee) || flipped(joint::kRightKnee) ||
                         flipped(joint::kLeftElbow) || flipped(joint::kRightElbow);
    const Eigen::VectorXd true_deg = reader_.ReadDeg(truth.pose);
    for (Eigen::Index a = 0; a < true_deg.size(); ++a) {
      const auto& [name, value] = person.angles_deg[static_cast<size_t>(a)];
      const auto dot = name.find('.');
      if (name.substr(dot + 1) != "flexion") continue;
      const auto hinge = FindJoint(name.substr(0, dot));
      HingeSum* const sum = name.find("elbow") != std::string::npos  ? &elbows_
                            : name.find("knee") != std::string::npos ? &knees_
                                                                     : nullptr;
      // The bone behind the hinge has the next number.
      if (sum && seen[static_cast<size_t>(*hinge)] && seen[static_cast<size_t>(*hinge + 1)])
        sum->Add(std::remainder(value - true_deg[a], 360.0));
    }
  }

  TrackErrors Errors() const {
    TrackErrors errors = errors_;
    const int known = errors.num_frames - errors.num_unknown;
    if (known == 0) return errors;
    errors.all_mm = 1e3 * all_m_ / (known * kNumJoints);
    errors.sure_share = static_cast<double>(num_sure_) / (known * kNumJoints);
    if (num_visible_ > 0) errors.visible_mm = 1e3 * visible_m_ / num_visible_;
    errors.elbows_deg = elbows_.Rms_deg();
    errors.knees_deg = knees_.Rms_deg();
    return errors;
  }

 private:
  JointAngleReader reader_;
  TrackErrors errors_;
  HingeSum elbows_, knees_;
  double all_m_ = 0.0, visible_m_ = 0.0;
  int num_visible_ = 0, num_sure_ = 0;
};

// Of the tags that frames show well, those that are found.
class DetectionSums {
 public:
  void Add(const testing::FrameTruth& truth, const std::vector<int>& tag_ids) {
    for (const testing::TagTruth& tag : truth.tags) {
      if (!IsWellSeen(tag)) continue;
      ++num_wanted_;
      num_found_ += std::ranges::count(tag_ids, tag.id) > 0;
    }
  }
  double Share() const {
    return num_wanted_ > 0 ? static_cast<double>(num_found_) / num_wanted_ : 0.0;
  }

 private:
  int num_wanted_ = 0, num_found_ = 0;
};

BodyTags Misplaced(BodyTags tags, const TrackExperimentOptions& options) {
  std::mt19937_64 rng(options.seed);
  std::normal_distribution<double> normal;
  const auto draw = [&](double sigma) {
    return Eigen::Vector3d(sigma * normal(rng), sigma * normal(rng), sigma * normal(rng));
  };
  for (BodyTag& tag : tags.tags) {
    tag.on_bone->bone_from_tag.translation() += draw(options.misplaced_m);
    const Eigen::Vector3d turn = draw(options.misplaced_rad);
    tag.on_bone->bone_from_tag.linear() *=
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    tag.on_bone->sigma_m = options.misplaced_m;
    tag.on_bone->sigma_rad = options.misplaced_rad;
  }
  return tags;
}

}  // namespace

Dress DressFor(const Skeleton& skeleton, const TrackExperimentOptions& options) {
  if (options.worn == TagsWorn::kPrinted) {
    const BodyTags printed = DefaultBodyTags();
    return {
        testing::OnSurface(Misplaced(OnBones(printed, TrimToJoints(skeleton)), options), skeleton),
        printed};
  }
  const BodyTags worn = testing::DefaultTagPlacement(
      skeleton, {.size_m = options.tag_size_m, .around = options.worn == TagsWorn::kAround});
  return {worn, Misplaced(worn, options)};
}

TaggedVideo RenderTagged(const Motion& motion, const BodyTags& worn,
                         const TrackExperimentOptions& options, const ProgressFn& progress) {
  const TagFamily family(worn.family);
  const Motion walk = testing::OnTheSpot(motion);
  const testing::PlacedCamera placed =
      testing::CameraBefore(walk, options.distance_m, 0.0, testing::Webcam(options.focal_px));
  const testing::BodyRenderer renderer(
      walk.skeleton, worn,
      [&](int id) {
        return testing::TagPrint{family.Image(id), family.cells_of_size()};
      },
      placed.camera, placed.cam_from_world,
      {.exposure_s = options.exposure_s,
       .noise_grey_levels = options.noise_grey_levels,
       .seed = options.seed});
  TagDetectorOptions detecting;
  for (const BodyTag& tag : worn.tags) detecting.known_ids.push_back(tag.id);
  TagDetector detector(family, detecting);
  TaggedVideo video{.camera = placed.camera, .frame_time_s = walk.frame_time_s};
  const auto poses = testing::PosesOver(walk);
  for (size_t t = 0; t < walk.frames.size(); ++t) {
    const auto frame = renderer.Render(poses, static_cast<double>(t) * walk.frame_time_s);
    cv::Mat& grey = video.grey.emplace_back(frame.picture);
    if (grey.channels() == 3) cv::cvtColor(frame.picture, grey, cv::COLOR_BGR2GRAY);
    video.detections.push_back(detector.Detect(grey));
    video.truth.push_back(frame.truth);
    if (progress) progress(static_cast<double>(t + 1) / static_cast<double>(walk.frames.size()));
  }
  return video;
}

std::vector<SightedFrame> SightFrames(const std::vector<const TaggedVideo*>& videos,
                                      const BodyTags& tags, const Camera& camera) {
  std::vector<SightedFrame> frames;
  double start_s = 0.0;
  for (const TaggedVideo* video : videos) {
    for (size_t t = 0; t < video->detections.size(); ++t)
      frames.push_back({start_s + static_cast<double>(t) * video->frame_time_s,
                        SightTags(video->detections[t], tags, camera)});
    if (!frames.empty()) start_s = frames.back().time_s + kSightedGap_s;
  }
  return frames;
}

TrackErrors TrackVideo(const TaggedVideo& video, const Skeleton& captured, const BodyTags& worn,
                       const BodyTags& tags, const Camera& camera, const PhotoLifter& lifter,
                       const std::shared_ptr<const MotionCodebook>& codebook, double depth_sigma) {
  TagSession session(tags, camera, lifter, codebook, {.tracker = {.depth_sigma = depth_sigma}});
  ErrorSums sums(captured);
  DetectionSums detected;
  for (size_t t = 0; t < video.grey.size(); ++t) {
    session.Add({.time_s = static_cast<double>(t) * video.frame_time_s, .grey = video.grey[t]});
    const auto tracked = session.Take();  // without latency there is one each time
    sums.Add(tracked->poses.people.front(), video.truth[t], FindSeen(worn, tracked->tag_ids));
    detected.Add(video.truth[t], tracked->tag_ids);
  }
  TrackErrors errors = sums.Errors();
  errors.detected_share = detected.Share();
  return errors;
}

double WholeFramesShare(const TaggedVideo& video) {
  DetectionSums detected;
  for (size_t t = 0; t < video.truth.size(); ++t) {
    std::vector<int> tag_ids;
    for (const TagDetection& detection : video.detections[t]) tag_ids.push_back(detection.id);
    detected.Add(video.truth[t], tag_ids);
  }
  return detected.Share();
}

}  // namespace poselift::cli
