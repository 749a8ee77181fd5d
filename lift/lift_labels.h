// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>

#include "lift/lift_photo.h"
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
};

// camera: when known, labels are freed of its lens distortion first.
LiftedLabels LiftLabels(const PhotoLifter& lifter, const Labels& labels,
                        const std::optional<Camera>& camera, const ProgressFn& progress);

// The first person of the frames in order, as one motion: y up, the camera
// level, the pelvis above the origin and the lowest joint on the floor. A frame
// in which nobody was lifted keeps the pose before it; frames before the first
// lifted one are left out.
Motion ToMotion(const LiftedLabels& lifted, const Skeleton& skeleton, double frame_time_s);

}  // namespace poselift
