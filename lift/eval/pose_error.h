// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "src/pose3.h"
#include "src/skeleton.h"

namespace poselift {

// Mean distance of the joints of two poses (3 x J, metres) in mm, after the
// estimate was moved onto the truth as well as it can be, in the least squares
// sense, by ...

// ... a similarity: rotation, translation and scale (PA, Procrustes).
double PaError_mm(const Pose3& estimate, const Pose3& truth);

// ... translation and scale alone: what a viewer in the camera's frame sees
// (CAM). The scale is positive.
double CamError_mm(const Pose3& estimate, const Pose3& truth);

// ... translation of the pelvis onto the pelvis alone: sizes count too.
double RootError_mm(const Pose3& estimate, const Pose3& truth);

// Mean angle between two poses' rotations of the root and of every bone that
// turns, each relative to its parent.
double MeanAngle_deg(const Skeleton& skeleton, const SkeletonPose& a, const SkeletonPose& b);

}  // namespace poselift
