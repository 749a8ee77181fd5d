// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "src/labels.h"

namespace poselift {

// Points followed through a video by pyramidal Lucas-Kanade flow (J.-Y. Bouguet,
// 2001), a step from each frame to the next. A step is checked by the way back
// (Z. Kalal, K. Mikolajczyk, J. Matas, Forward-Backward Error, 2010): a point is
// lost where it does not come back to within max_round_trip of where it was;
// else the error counts. Its drift is taken for a random walk, with the variance
//   s = sum over the steps (step_sigma^2 + round_trip^2).
struct FlowOptions {
  double window = 0.08;  // side of the flow's window, of the person's extent
  int pyramid_levels = 3;
  double max_round_trip = 0.1;  // of the window
  double step_sigma = 0.03;     // drift of a step (standard deviation), of the window

  std::string Validate() const;  // empty when all is well, else what is wrong
};

struct FollowedPoint {
  Eigen::Vector2d x_px = Eigen::Vector2d::Zero();
  double variance_px2 = 0.0;  // s, of each axis
  bool known = false;         // false: lost, or never followed
};
using FollowedPoints = std::vector<std::vector<FollowedPoint>>;  // [person][landmark]

// A picture with its smaller copies, for windows of any person.
using FlowPyramid = std::vector<cv::Mat>;
FlowPyramid MakeFlowPyramid(const cv::Mat& grey, const FlowOptions& options);

class FlowFollower {
 public:
  // Follows the visible labels; what is occluded would lead to what hides it.
  FlowFollower(const FrameLabels& labels, const FlowOptions& options);

  void Step(const FlowPyramid& from, const FlowPyramid& to);
  const FollowedPoints& points() const { return points_; }  // places as in the labels

 private:
  void StepPerson(const FlowPyramid& from, const FlowPyramid& to, size_t person);

  FlowOptions options_;
  FollowedPoints points_;
  std::vector<int> windows_px_;  // [person], odd
};

}  // namespace poselift
