// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "lift/body_proportions.h"
#include "lift/frame_span.h"
#include "lift/lift_photo.h"
#include "lift/temporal/local_pose.h"
#include "lift/temporal/motion_codebook.h"
#include "lift/temporal/segment_views.h"
#include "lift/temporal/sequence_refinement.h"
#include "src/joint_angles.h"
#include "src/progress.h"

namespace poselift {

struct LiftSequenceOptions {
  double label_cutoff_hz = 4.0;  // of the label curves that frames are lifted from
  double max_gap_s = 0.5;        // longer without labels, a frame has no pose
  int num_neighbours = 50;
  double depth_weight = 0.4;  // of SegmentViews
  SegmentViewsOptions views;
  LocalPoseOptions local;
  SequenceRefinementOptions refinement;
  // Whether the proportions of the body are found out, where all points are 2D; else
  // they are the standard ones.
  bool find_proportions = true;
  // Of the angles' standard deviations, to those of the refinement. It takes the errors
  // of neighbours and labels for independent from frame to frame, which they are not:
  // bodies do what no neighbour does for a second, with their limbs above all.
  double trunk_sigma_factor = 2.3;
  double limb_sigma_factor = 5.2;

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct LiftedSequence {
  // A frame each. The first pose of a frame is that of the whole sequence, and says how
  // sure its angles are; behind it come the alternatives of the frame by itself.
  std::vector<LiftResult> frames;
  std::vector<bool> filled;  // there were too few labels for the frame alone
  // One body in all poses of all frames. There is a covariance where its proportions
  // were found out.
  BodyProportions body;
  Skeleton skeleton;  // of these proportions, as tall as the standard one
};

// From the observed points of one person in the frames of a video to poses that
// are one motion. The camera is level and stands still, or nearly so; in true
// perspective where it is known, else in weak perspective.
class SequenceLifter {
 public:
  // The lifter and the codebook must outlive this. Throws InputError for options
  // that are wrong and for a codebook of another skeleton than the dictionary's.
  SequenceLifter(const PhotoLifter& lifter, const MotionCodebook& codebook,
                 const LiftSequenceOptions& options = {});

  // frames: at even times; one without points is a frame where nothing was seen. Hints of
  // a frame count where it is lifted alone and in the motion; they do not reach others by
  // themselves. The first frame that says how tall the person is says so for all.
  // The longest frame time at which a motion can be told is kLongestFrameTime_s;
  // beyond it throws InputError. What progress throws ends the work and comes out.
  LiftedSequence LiftSequence(const std::vector<Observation>& frames, double frame_time_s,
                              const ProgressFn& progress = {}) const;

  static constexpr double kLongestFrameTime_s = 0.1;

 private:
  struct Run;
  LiftedSequence LiftAtSkeletonSize(const std::vector<Observation>& frames, double frame_time_s,
                                    const ProgressFn& progress) const;
  bool LiftEach(Run* run, const ProgressFn& progress) const;
  void FindLocalPoses(Run* run) const;
  void GatherEvidence(Run* run) const;
  BodyProportions FindProportions(std::vector<Run>* runs) const;
  std::vector<LiftedPose> Refine(const Run& run, const Skeleton& skeleton,
                                 const GroupVector& log_ratios) const;
  Eigen::VectorXd AnglesSigma_deg(const RefinedFrame& frame) const;

  const PhotoLifter& lifter_;
  const MotionCodebook& codebook_;
  LiftSequenceOptions options_;
  SequenceRefinement refinement_;
  JointAngleReader angles_;
};

}  // namespace poselift
