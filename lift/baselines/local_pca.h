// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <string>
#include <vector>

#include "lift/baselines/feature_points.h"
#include "lift/ik/articulation.h"
#include "lift/temporal/motion_database.h"
#include "lift/temporal/motion_method.h"
#include "lift/temporal/segment_search.h"

namespace poselift {

struct LocalPcaOptions {
  int num_neighbours = 100;  // K, taken of the segments that the search finds
  // What a metre between the observed points and an example's counts in its
  // distance, beside the weighted features of the last poses.
  double observed_scale_per_m = 20.0;
  double variance_kept = 0.999;     // by the subspace, of that of the K examples
  double prior_sigma_factor = 1.0;  // the examples' standard deviations times this
  // Of the change of the change from frame to frame: radians and metres.
  double smoothness_sigma = 0.2;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// Motion reconstruction by local PCA (J. Chai, J. K. Hodgins, Performance Animation
// from Low-dimensional Control Signals, 2005). Of the database's poses that follow
// what is like the last poses, the K are taken whose distance, that of their
// observed points included, is least. With their mean and leading principal
// directions, features over the search's row weights,
//
//   y_t = mean + U w
//   min_w  sum_i |m_i f(q(y_t)) - c_i|^2 / sigma_i^2        control
//        + sum_j (w_j / (factor stddev_j))^2                prior
//        + |y_t - 2 y_{t-1} + y_{t-2}|^2 / smoothness^2     smoothness
//
// by Levenberg-Marquardt from the nearest example. The second difference is of
// angles, height and tilt; for the other three features, which are velocities
// already, it is the change of what they move in a frame.
class LocalPca : public MotionMethod {
 public:
  // The search, over the segments of the database, finds the candidates. Both
  // must outlive this. Throws InputError when the options are invalid.
  LocalPca(const MotionDatabase& database, const SegmentSearch& search,
           const LocalPcaOptions& options = {});

  // At least max(m, 2) + 1 poses. Throws std::invalid_argument for fewer.
  void Begin(const std::vector<SkeletonPose>& first) override;
  SkeletonPose Next(const std::vector<TargetPoint>& observed) override;

 private:
  // examples_: 46 x K features, the nearest first.
  void FindExamples(const FeatureMatrix& past);
  // mean_, directions_ (46 x B, in units of the features) and stddevs_.
  void FitSubspace();
  FeatureVector Solve(const FeatureMatrix& past);

  const MotionDatabase& database_;
  const SegmentSearch& search_;
  LocalPcaOptions options_;
  Articulation body_;
  FeaturePoints points_;
  SearchCursor cursor_;
  std::vector<SegmentMatch> matches_;
  std::vector<SkeletonPose> past_;  // max(m, 2) + 1, the oldest first
  FeatureMatrix candidates_, examples_;
  Eigen::VectorXd distances_;
  FeatureVector mean_;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen_;
  Eigen::MatrixXd directions_;
  Eigen::VectorXd stddevs_;
};

}  // namespace poselift
