// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift/temporal/pose_prediction.h"
#include "lift/temporal/segment_views.h"

namespace poselift {

struct LocalPoseOptions {
  // h of the weights: of E, the mean squared distance of a point.
  double bandwidth_m = 0.035;
  // What any neighbour may be off, and how that grows with delta, how far the
  // points of the neighbours are from those seen, beyond the labels' own noise:
  //   sigma = least_sigma_rad + sigma_per_m delta (1 + (delta / far_m)^4)
  // Beyond far_m a match says little: nothing like it is in the codebook.
  double least_sigma_rad = 0.05;
  double sigma_per_m = 1.5;
  double far_m = 0.08;
  double label_sigma_m = 0.015;
  double shrinkage = 0.3;  // correlations are multiplied by 1 - shrinkage

  std::string Validate() const;  // empty, or which option is wrong and why
};

// What the neighbours of a moment say of it: a local model of order zero, the
// weighted mean and covariance of their middle poses, and of how these change. Weights as Eq. (7)
// of the motion paper,
//   omega_k = exp(-(E_k - min E) / (2 h^2)), of sum 1.
struct LocalPose {
  // In cam, the root at the origin. The whitening has 43 rows and knows nothing
  // of the root's place; its frame time is 1 s.
  PosePrediction prediction;
  Eigen::VectorXd rate_rad_per_s;  // of the 40 angles
  // Their accelerations, rad/s^2, and the standard deviation of these.
  Eigen::VectorXd acceleration, acceleration_deviation;
  // How far the neighbours are: sigma over least_sigma_rad. What they say of
  // rates is less sure by this factor.
  double doubt = 1.0;
};

// views: at least one. depth_weight: that of the search.
LocalPose MakeLocalPose(const MotionCodebook& codebook, const std::vector<SegmentView>& views,
                        double depth_weight, const LocalPoseOptions& options = {});

}  // namespace poselift
