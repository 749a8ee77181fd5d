// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift/temporal/motion_database.h"

namespace poselift {

// What bodies do within half a second, as segments that stand for what was
// captured, without its frames: the means of cells of alike segments
// (lift/train/train_codebook.h).
//
// A segment is kSegmentSamples poses, sample_time_s apart, oldest first, of
// kNumFeatures numbers each, free of place and heading. With p the root's place
// and R_yaw its heading (motion_features.h), of the sample and of the middle one:
//
//   rows 0..39   angles, radians, continuous over the segment
//   row  40      height p_y, metres
//   rows 41, 42  tilt, as in motion_features.h, radians
//   rows 43, 44  x (to the subject's left) and z (forward) of
//                R_yaw(middle)^T (p - p_middle), metres
//   row  45      yaw - yaw_middle, radians, unwrapped
inline constexpr int kSegmentSamples = 5;
inline constexpr int kMiddleSample = 2;
inline constexpr int kSegmentRows = kSegmentSamples * kNumFeatures;  // 230

namespace segment_row {  // of a sample; the others are those of namespace feature
inline constexpr int kPlace = 43, kYaw = 45;
}  // namespace segment_row
inline constexpr int kPoseRows = segment_row::kPlace;  // without place and yaw

// How a codebook came to be; a part of its file.
struct CodebookRecord {
  std::vector<std::string> sources;  // the motion files' names
  std::string command;
  std::string commit;
  long num_segments = 0;  // that were captured, for the codebook's to stand for
  unsigned long seed = 0;
  double rms_error_mm = 0.0;  // of the captured segments' joints (CodebookReport)
};

// How the rates go on from a segment's middle, a local regression of order one for
// each (Eq. 3-10 of the motion paper, m = 2), with x_c the segment's own x:
//
//   a(x) = mean + R D^T (x - x_c) + N(0, deviation^2),   x = [rows 0..42; rates]
//
// a: mean change of the rates over the next kAccelerationTime_s, per second, as the
// body that turns has it. D, 89 x kAccelerationRank, are the principal directions of
// x among what was captured around x_c, R, 46 x kAccelerationRank, what follows.
inline constexpr double kAccelerationTime_s = 1.0 / 15.0;
inline constexpr int kAccelerationRank = 2;
inline constexpr int kAccelerationInputs = kPoseRows + kNumFeatures;

struct AccelerationModels {  // a column a segment
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> means;
  // Columns of D, and of R, one under the other. Zeros for captured segments.
  Eigen::Matrix<float, kAccelerationInputs * kAccelerationRank, Eigen::Dynamic> directions;
  Eigen::Matrix<float, kNumFeatures * kAccelerationRank, Eigen::Dynamic> responses;
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> deviations;

  static AccelerationModels Zero(Eigen::Index num_segments);
};

struct MotionCodebook {
  Skeleton skeleton;
  double sample_time_s = 2.0 / 15.0;
  Eigen::Matrix<float, kSegmentRows, Eigen::Dynamic> segments;  // samples one under the other
  // Change per second at the middle sample, of the rows above.
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> rates;
  // Standard deviation of the middle sample within what the segment stands for.
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> deviations;
  AccelerationModels accelerations;
  CodebookRecord record;

  int NumSegments() const { return static_cast<int>(segments.cols()); }
  // x of the regressions, of all segments.
  Eigen::Matrix<float, kAccelerationInputs, Eigen::Dynamic> AccelerationInputs() const;
};

// How far the 23 joints move (RMS), metres, by a unit of each row of the middle
// sample: mean over the codebook's segments.
FeatureVector LeverArms(const MotionCodebook& codebook);
// What turns no joint's place must not differ at will: where segments are compared,
// no lever arm is shorter.
inline constexpr double kShortestLeverArm_m = 0.02;

// All segments of a database, every stride_frames-th frame as the middle, with
// deviations of zero. None reaches beyond its trial. Rates are central
// differences over two frames either way. The frame time is a whole part of
// kAccelerationTime_s too. Throws InputError when sample_time_s
// is no whole number, from 1, of the database's frames.
MotionCodebook SegmentsOf(const MotionDatabase& database, int stride_frames = 3);

// The codebook and, behind it, its left-right mirror image. Its skeleton is its
// own mirror image.
MotionCodebook WithMirrored(const MotionCodebook& codebook);

// The pose of a sample (kNumFeatures numbers of a segment) in the world whose
// origin is on the floor under the middle sample's root, which heads for z.
SkeletonPose PoseOfSample(const FeatureVector& sample);

}  // namespace poselift
