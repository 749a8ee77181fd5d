// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>

#include "lift/lift_photo.h"
#include "lift/lift_sequence.h"
#include "src/camera.h"
#include "src/labels.h"
#include "src/layout.h"
#include "src/motion.h"
#include "src/poses.h"
#include "src/progress.h"

namespace poselift {

// Every person of every frame of a labels file, lifted on its own, in parallel.
struct LiftedLabels {
  Poses poses;                                   // frame by frame as in the labels
  std::vector<std::vector<LiftResult>> results;  // [frame][person]
  // Of key frames and what lies between (key_frames.h), evenly in time and without a camera.
  std::optional<double> key_frame_time_s = {};
};

// A person as poses.json has it, at their own size where that is known. observation: of labels.
PersonPose ToPersonPose(const LiftResult& result, const Observation& observation,
                        const PersonLabels& labels, const Skeleton& skeleton);

// camera: when known, labels are freed of its lens distortion first.
LiftedLabels LiftLabels(const PhotoLifter& lifter, const Labels& labels,
                        const std::optional<Camera>& camera, const ProgressFn& progress);

// The same of a video: every person's frames as one motion (LiftSequence). In
// frames between the first and the last of a person who has no labels there, the
// poses are filled where the gap is short enough, with the status "filled".
// labels: with times, and every person in each frame (WithPeopleBetween).
// Throws InputError when the frames' times do not grow.
LiftedLabels LiftLabelsOverTime(const SequenceLifter& lifter, const Skeleton& skeleton,
                                const Labels& labels, const std::optional<Camera>& camera,
                                const ProgressFn& progress);

// The first person as one motion, filled frames too: where the picture or the
// known camera has them (PosesToMotion), floor and all. A frame of which nothing
// is known keeps the pose before it. Of key frames, which no camera sees: ToMotion. Throws
// InputError when nobody was lifted.
Motion ToMotionOverTime(const LiftedLabels& lifted, const Skeleton& skeleton,
                        const ProgressFn& progress = {});

// Each person is in all frames from their first to their last, without landmarks
// where there were no labels.
Labels WithPeopleBetween(const Labels& labels);

// The first person of the frames in order, as one motion: y up, the camera
// level, the pelvis above the origin and the lowest joint on the floor. A frame
// in which nobody was lifted keeps the pose before it; frames before the first
// lifted one are left out.
Motion ToMotion(const LiftedLabels& lifted, const Skeleton& skeleton, double frame_time_s);

}  // namespace poselift
