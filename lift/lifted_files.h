// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>

#include "lift/lift_labels.h"
#include "src/labels.h"
#include "src/skeleton.h"

namespace poselift {

// The time between frames: from their times where they have them, else by fps.
double FrameTime_s(const Labels& labels, double fps);

// What `lift` leaves in a folder, but pictures: poses.json, angles.csv, of one motion
// angles_sigma.csv, and of the first person poses.bvh, poses.amc and poses.asf, unless nobody was
// lifted. Throws InputError when a file cannot be written.
void WriteLifted(const LiftedLabels& lifted, const Labels& labels, const Skeleton& skeleton,
                 bool is_motion, double fps, const std::filesystem::path& folder);

}  // namespace poselift
