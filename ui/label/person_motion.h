// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "lift/frame_span.h"
#include "lift/lift_labels.h"
#include "src/labels.h"

namespace poselift {

// One person of labels with times, lifted as one motion.
struct PersonMotion {
  std::uint64_t number = 0;  // of the request that it answers; grows
  int person_id = 0;
  std::string message;  // why there is no motion, in words; empty when there is one
  FrameSpan video;      // of the labels' frames: what was lifted (FramesOfVideo)
  LiftedLabels lifted;  // these frames, nobody else in them; no alternatives
  // Of frames as in the labels up to its last one, or all between key frames; NaN where there is
  // no pose. Angles: JointAngles() x frames, degrees.
  Eigen::VectorXd times_s;
  Eigen::MatrixXd angles_deg, angles_sigma_deg;
  std::vector<bool> is_filled;             // from the frames around, for want of labels
  std::vector<std::uint64_t> label_marks;  // LabelMarks of what was lifted

  bool HasPoses() const { return message.empty(); }
  const LiftedPose* PoseOf(size_t frame) const;  // null where there is none
  // How sure a frame is: the root mean square of its angles' deviations; NaN where unknown.
  double Sigma_deg(size_t frame) const;
};

// The labels of one person alone, in all of these frames from their first to their last.
Labels OnlyPerson(const Labels& labels, int person_id, const FrameSpan& frames);

// A number for each of these frames, of those beyond 0: another when the person's labels or hints,
// or the frame's time, are.
std::vector<std::uint64_t> LabelMarks(const Labels& labels, int person_id, const FrameSpan& frames);

// What `lift` makes of labels with times, all people, with the motion codebook that ships. Throws
// InputError when the frames are no motion (WhyFramesAlone); what progress throws comes out.
LiftedLabels LiftAsMotion(const PhotoLifter& lifter, const Labels& labels,
                          const ProgressFn& progress);

// One of them, in the video of this frame. Where there is no motion, the message says why.
PersonMotion LiftPersonAsMotion(const PhotoLifter& lifter, const Labels& labels, int person_id,
                                size_t frame, const ProgressFn& progress);

}  // namespace poselift
