// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lift/camera_track.h"
#include "src/motion.h"
#include "src/poses.h"
#include "src/progress.h"

namespace poselift {

// One person of lifted poses (poses.json) as a motion, and the way back.
//
// World is that of a level camera: y up, x to the camera's right, z towards it.
// Its origin lies below the pelvis of the first known frame, at the height of
// the floor: the 5 % quantile over the frames of the lowest joint's height.
//
// Where the pelvis is known (pelvis_in_cam_m) the root is there. Else it is in
// the picture's plane, where weak perspective has it,
//   x_m = (translation_px - centre_px) / scale_px_per_m,
// with its depth 0 throughout. centre_px stands for the principal point, which
// nobody told: it is the median of the translations, so that noise of the scale
// moves the body as little as can be. Poses without any picture stay over the
// origin, and rest on the floor in every frame.

struct PosesToMotionOptions {
  std::optional<int> person_id;        // else the first person of the first frame with any
  std::optional<double> frame_time_s;  // instead of the frames' times
  // Whether frames with the status "filled", guessed when the motion was
  // smoothed, count as known.
  bool with_filled = false;
};

// The statuses of frames that were filled, and of which nothing is known.
inline constexpr std::string_view kFilledStatus = "filled";
inline constexpr std::string_view kUnknownStatus = "not known";
inline constexpr std::string_view kUnknownMessage = "in a gap that is too long to be filled";

struct PosesMotion {
  Motion motion;  // unknown frames where the person has no pose
  int person_id = 0;
  std::optional<PersonBones> bones;  // of the skeleton, where the poses tell them
  bool is_resampled = false;         // the times' steps were uneven: resampled to the median step
  // Of each frame of the motion: its frame in the poses (-1: there is none), its
  // time (none when frame_time_s was given) and its picture (may be empty).
  std::vector<int> source_frames;
  std::vector<double> times_s;
  std::vector<std::string> images;
  std::vector<bool> is_filled;  // by its status; with with_filled alone
  // JointAngles() x frames as the poses name them, and how sure they are: joints do not
  // tell every angle. NaN where they do not say; empty where they never say how sure.
  Eigen::MatrixXd angles_deg, angles_sigma_deg;
  CameraTrack camera;
  double worst_ik_rms_m = 0.0;  // how far the skeleton's joints are from the poses'
  int num_ik_failures = 0;      // poses that no skeleton fits: unknown frames too
};

// Joint angles by inverse kinematics, each frame from the one before, on the
// skeleton, with the person's own lengths where the poses have them.
// Throws InputError when there is no such person, when no frame of theirs is
// ok, or when the times are no times (frame_grid.h) or missing.
PosesMotion PosesToMotion(const Poses& poses, const Skeleton& skeleton,
                          const PosesToMotionOptions& options = {},
                          const ProgressFn& progress = {});

// A motion as poses of one person, before the camera of `source` and with its
// times and pictures. statuses: of each frame; those of kUnknownStatus get no
// pose. What was measured on labels (reprojection, atoms) is left out.
// Throws std::invalid_argument when the numbers of frames differ, InputError for
// a skeleton without the bones of the CMU skeleton.
Poses MotionToPoses(const Motion& motion, const PosesMotion& source,
                    const std::vector<std::string>& statuses);

}  // namespace poselift
