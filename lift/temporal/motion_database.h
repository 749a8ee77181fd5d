// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "lift/temporal/motion_features.h"
#include "lift/train/training_poses.h"
#include "src/progress.h"

namespace poselift {

// Captured motion to learn from, as features (motion_features.h) of one standard
// skeleton at one frame time: the trials side by side, one column a frame. Where
// angles jump (see OnStandardSkeleton) a trial is cut, and counts as several.
struct Trial {
  std::string name;  // the AMC file's, without its ending; of a mirror image with "/mirrored"
  int first_frame = 0;
  int num_frames = 0;
};

struct MotionDatabase {
  Skeleton skeleton;
  double frame_time_s = 1.0 / 60.0;
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> features;  // unscaled
  std::vector<Trial> trials;                                    // in the order of their frames

  int NumFrames() const { return static_cast<int>(features.cols()); }
  // Puts a trial behind the others.
  void Append(const std::string& name, const FeatureMatrix& trial_features);
};

// The trials of these names, with their mirror images. Names that no trial has are
// of no concern.
MotionDatabase SubsetOfTrials(const MotionDatabase& database,
                              const std::vector<std::string>& names);

// Trials drawn by the seed until they and their mirror images have at least so many
// frames, or all of them.
MotionDatabase DrawTrials(const MotionDatabase& database, int num_frames, uint64_t seed);

// A segment is named by its last frame t: it is the frames t-m+1 .. t of one
// trial, and the frame t+1 that follows is of the same trial. All of them, in
// order.
std::vector<int> SegmentEnds(const MotionDatabase& database, int num_frames);

// 1/sigma of each row, what a distance multiplies differences with. Sigma is the
// standard deviation over the database (root mean square over the rows of a
// group), and 1 where nothing varies. Five groups have a sigma each: angles,
// height, tilt, velocity, yaw rate. Angles share one, so that a joint which
// hardly moves does not count as much as the knees. The W of the paper is the
// identity: FeatureVector::Ones().
FeatureVector RowWeights(const MotionDatabase& database);

// The motion on the standard skeleton (RebaseMotion) at the frame time: what the
// database holds and what its queries should be.
//
// The root's path is scaled by the ratio of the legs' lengths, so that feet on
// the floor, y = 0, are on it still. Of the angles that are one rotation each
// frame has those nearest to the rest pose: a pose is the same numbers in all
// trials. The price is a jump where a bone passes gimbal lock or half a turn.
Motion OnStandardSkeleton(const Motion& motion, const Skeleton& standard, double frame_time_s);

// Of the angles that are the same rotation those nearest to the rest pose: the
// branch on which the database has them.
void TakeAnglesNearestToRest(const Skeleton& skeleton, SkeletonPose* pose);

// Of motions, those whose subject ("07") or trial ("07_05") is in `include`, all
// when that is empty, and not in `exclude`. Throws InputError for a name that no
// motion has.
std::vector<MotionSource> ChooseTrials(const std::vector<MotionSource>& sources,
                                       const std::vector<std::string>& include,
                                       const std::vector<std::string>& exclude);

struct DatabaseOptions {
  double frame_time_s = 1.0 / 60.0;
  bool mirrored = true;  // each trial also left-right mirrored
};

// standard: symmetric, as MeanSkeleton makes it. Throws InputError for a file
// that cannot be read and a skeleton that is not CMU's.
MotionDatabase LoadMotionDatabase(const std::vector<MotionSource>& sources,
                                  const Skeleton& standard, const DatabaseOptions& options = {},
                                  const ProgressFn& progress = {});

}  // namespace poselift
