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

// How a codebook came to be; a part of its file.
struct CodebookRecord {
  std::vector<std::string> sources;  // the motion files' names
  std::string command;
  std::string commit;
  long num_segments = 0;  // that were captured, for the codebook's to stand for
  unsigned long seed = 0;
  double rms_error_mm = 0.0;  // of the captured segments' joints (CodebookReport)
};

struct MotionCodebook {
  Skeleton skeleton;
  double sample_time_s = 2.0 / 15.0;
  Eigen::Matrix<float, kSegmentRows, Eigen::Dynamic> segments;  // samples one under the other
  // Change per second at the middle sample, of the rows above.
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> rates;
  // Standard deviation of the middle sample within what the segment stands for.
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> deviations;
  CodebookRecord record;

  int NumSegments() const { return static_cast<int>(segments.cols()); }
};

// All segments of a database, every stride_frames-th frame as the middle, with
// deviations of zero. None reaches beyond its trial. Rates are central
// differences over two frames either way. Throws InputError when sample_time_s
// is no whole number, from 1, of the database's frames.
MotionCodebook SegmentsOf(const MotionDatabase& database, int stride_frames = 3);

// The codebook and, behind it, its left-right mirror image. Its skeleton is its
// own mirror image.
MotionCodebook WithMirrored(const MotionCodebook& codebook);

// The pose of a sample (kNumFeatures numbers of a segment) in the world whose
// origin is on the floor under the middle sample's root, which heads for z.
SkeletonPose PoseOfSample(const FeatureVector& sample);

}  // namespace poselift
