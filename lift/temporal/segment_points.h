// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "lift/temporal/motion_database.h"

namespace poselift {

// A squared distance and a point: ordered by distance, then by place.
using Candidate = std::pair<float, int>;

// The segments of a database as points of m x 46 scaled numbers, oldest frame
// first. The frames of a trial lie one behind the other in memory, so a point is
// a window on them and neighbours in time share their numbers.
class SegmentPoints {
 public:
  SegmentPoints(const MotionDatabase& database, const FeatureVector& row_weights, int num_frames)
      : num_frames_(num_frames),
        frames_(row_weights.cast<float>().asDiagonal() * database.features),
        ends_(SegmentEnds(database, num_frames)) {}

  int size() const { return static_cast<int>(ends_.size()); }
  int dim() const { return kNumFeatures * num_frames_; }
  int EndFrame(int point) const { return ends_[point]; }

  const float* Point(int point) const { return frames_.col(ends_[point] - num_frames_ + 1).data(); }

  float SquaredDistance(const float* a, int point) const {
    return (Values(a, dim()) - Values(Point(point), dim())).squaredNorm();
  }

  // The segment one frame later, or -1 at the end of a trial.
  int Next(int point) const {
    return point + 1 < size() && ends_[point + 1] == ends_[point] + 1 ? point + 1 : -1;
  }

 private:
  using Values = Eigen::Map<const Eigen::VectorXf>;

  int num_frames_;
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> frames_;  // scaled
  std::vector<int> ends_;
};

}  // namespace poselift
