// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift/temporal/motion_codebook.h"

namespace poselift {

// What differences of x, the inputs of AccelerationModels, are multiplied by before
// they are compared: lever arms, the rates' times the time between two samples. They
// are metres then.
Eigen::VectorXd AccelerationMetric(const MotionCodebook& codebook);

// How the rates of a motion go on: the local regressions of the segments that are
// nearest to its pose and rates, weighted as Eq. (7) of the motion paper.
class AccelerationModel {
 public:
  // codebook: with its mirror images (WithMirrored). It must outlive this.
  explicit AccelerationModel(const MotionCodebook& codebook);

  struct Prediction {
    FeatureVector mean;      // per second of the rates, in the heading
    FeatureVector variance;  // of the regressions, and of what they differ by
  };

  // pose: features (motion_features.h), of which rows 0..42 count; rates: their
  // change per second, place and yaw as in MotionCodebook::rates. Keeps its storage;
  // the cost is one product with all segments.
  const Prediction& At(const FeatureVector& pose, const FeatureVector& rates);

  static constexpr int kNumNeighbours = 16;

 private:
  const MotionCodebook& codebook_;
  Eigen::VectorXf metric_;
  Eigen::MatrixXf inputs_;      // 89 x N, under the metric
  Eigen::VectorXf half_norms_;  // N
  Eigen::VectorXf scores_;
  std::vector<int> order_;
  Prediction prediction_;
};

}  // namespace poselift
