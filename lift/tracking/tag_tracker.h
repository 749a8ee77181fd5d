// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lift/lift_photo.h"
#include "lift/temporal/motion_filter.h"
#include "lift/tracking/worn_tags.h"
#include "src/body_tags.h"
#include "src/camera.h"
#include "src/tag_detection.h"

namespace poselift {

class PoseProblem;

// The pose of a person who wears tags, frame after frame. Each frame is the maximum of
//
//   sum_tags rho(|W (corners(q) - corners)|^2)          tags on bones (tag_cost.h)
// + sum_tags rho(|W (x_joint(q) - x)|^2)                tags by a joint, at their pose
// + |q - foretold|^2 by its variances                   the motion model (motion_filter.h)
// + dt prior_weight^2 |whitening (f_0(q) - mean)|^2     how common poses are
// + dt pull^2 |dofs|^2                                  what nothing shows goes to rest
//
// over q, by Levenberg-Marquardt; its curvature says how sure the pose is, and both go
// back to the filter. Corners do not choose between the two ways a tag may lean, the
// body does. Without a foretold pose the joints that the tags tell are lifted
// (PhotoLifter), and each pose that comes of it is a start.
struct TagTrackerOptions {
  MotionFilterOptions filter{.latency_s = 0.0, .variance_scale = 15.0};
  double corner_sigma_px = 0.15;
  double depth_sigma = 0.0;  // TagSigmas: of a camera that is guessed
  double prior_weight = 1.5;
  double loss = 6.0;   // Cauchy: standard deviations of all a tag's corners together
  int least_tags = 3;  // for a pose out of nothing

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct TrackedTag {
  int id = 0;
  bool is_ambiguous = false;
  bool is_believed = true;
  double sigmas = 0.0;    // how far it is off, in standard deviations of all its corners
  double error_px = 0.0;  // of its corners to the pose, RMS
};

struct TrackedFrame {
  SmoothedFrame body;            // in world: y up, the camera at the origin
  std::vector<TrackedTag> tags;  // that the person wears and the frame shows
  Eigen::MatrixXd covariance;    // PoseProblem::Covariance; empty where tags gave no pose
};

class TagTracker {
 public:
  // skeleton: the person's. cam_from_world: how the camera stands, a rotation. lifter and
  // its dictionary must outlive this. Throws InputError for wrong options, for tags on
  // bones or joints that the skeleton does not have, and for a codebook of another body.
  TagTracker(const Skeleton& skeleton, const BodyTags& tags, const Camera& camera,
             const Eigen::Quaterniond& cam_from_world, const PhotoLifter& lifter,
             std::shared_ptr<const MotionCodebook> codebook, const TagTrackerOptions& options = {});

  // The next frame; tags of others are passed over. Throws InputError when time does not go on.
  void Add(double time_s, const std::vector<TagSighting>& seen);
  void End() { filter_.End(); }  // no more frames come
  // The oldest frame that has waited for long enough.
  std::optional<TrackedFrame> Take();

  // Where the tags on bones are to be looked for at a time soon after the newest frame:
  // ids and corners. None that turn away or leave the picture.
  std::vector<TagDetection> Expected(double time_s) const;

 private:
  struct Solution {
    SkeletonPose pose;
    Eigen::MatrixXd covariance;
    double cost = 0.0;
    std::vector<TrackedTag> tags = {};
    double misfit = 0.0;  // of the tags
  };
  struct Waiting {
    std::vector<TrackedTag> tags;
    Eigen::MatrixXd covariance;
  };

  std::vector<SkeletonPose> FirstPoses(const std::vector<SeenTag>& seen) const;
  std::optional<Solution> Solve(const std::vector<SeenTag>& seen, const SkeletonPose& start,
                                const std::optional<MotionFilter::Prediction>& prediction,
                                double share, double loss) const;
  std::optional<Solution> SolveOn(const std::vector<SeenTag>& seen,
                                  const MotionFilter::Prediction& prediction, double dt_s) const;
  bool NoteDoubts(double time_s, const std::vector<TrackedTag>& tags);
  void TryAnew(double time_s, const std::vector<SeenTag>& seen, std::optional<Solution>* solution);
  std::optional<Solution> SolveAnew(const std::vector<SeenTag>& seen) const;
  void AddTerms(const std::vector<SeenTag>& seen, const SkeletonPose& start,
                const std::optional<MotionFilter::Prediction>& prediction, double loss,
                PoseProblem* problem) const;
  std::vector<TrackedTag> Judge(const std::vector<SeenTag>& seen, const SkeletonPose& pose) const;
  TagInPicture InPicture(const SeenTag& tag, const BoneFrames& frames) const;
  PointInSpace InSpace(const SeenTag& tag, const BoneFrames& frames) const;

  Articulation body_;
  WornTags worn_;
  const PhotoLifter& lifter_;
  Articulation standard_;  // the skeleton that poses were learned on
  TagTrackerOptions options_;
  MotionFilter filter_;
  double last_s_ = 0.0;
  std::map<int, double> doubted_s_;  // when tags were last not believed, by their ids
  // When a pose found anew is next tried, and how long the pause was before.
  double next_try_s_ = -std::numeric_limits<double>::infinity(), pause_s_ = 0.15;
  std::deque<Waiting> waiting_;
};

}  // namespace poselift
