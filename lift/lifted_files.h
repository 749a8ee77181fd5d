// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "lift/frame_span.h"
#include "lift/lift_labels.h"
#include "src/labels.h"
#include "src/progress.h"
#include "src/skeleton.h"

namespace poselift {

// The time between frames: from their times where they have them, else by fps.
double FrameTime_s(const Labels& labels, double fps);

// The frames around this one that are of its video, or of none as it is; there must be one.
FrameSpan FramesOfVideo(const Labels& labels, size_t frame);

// Why each frame is lifted by itself, in words; empty when the frames are those of one motion: more
// than two, of one video, all with times, no longer apart than SequenceLifter::kLongestFrameTime_s;
// or key frames (key_frames.h). Times that do not grow are found by the lifter.
std::string WhyFramesAlone(const Labels& labels);

// What `lift` leaves in a folder, but pictures: poses.json, angles.csv, of one motion
// angles_sigma.csv, unless of key frames, and of the first person poses.bvh, poses.amc and
// poses.asf, unless nobody was lifted. Throws InputError when a file cannot be written; before the
// first one is, what progress throws.
void WriteLifted(const LiftedLabels& lifted, const Labels& labels, const Skeleton& skeleton,
                 bool is_motion, double fps, const std::filesystem::path& folder,
                 const ProgressFn& progress = {});

// What one motion can be written as, by the ending of the file.
struct LiftedFormat {
  std::string_view ending;  // ".bvh"
  std::string_view name;    // for a list to choose from
};
std::span<const LiftedFormat> LiftedFormats();

// One file of the first person of frames lifted over time. Throws InputError for another ending,
// when nobody was lifted and when the file cannot be written; before it is, what progress throws.
void WriteLiftedMotion(const LiftedLabels& lifted, const Skeleton& skeleton,
                       const std::filesystem::path& path, const ProgressFn& progress = {});

}  // namespace poselift
