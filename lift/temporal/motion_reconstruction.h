// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift/ik/articulation.h"
#include "lift/temporal/local_regression.h"
#include "lift/temporal/motion_database.h"
#include "lift/temporal/motion_method.h"
#include "lift/temporal/pose_prediction.h"
#include "lift/temporal/segment_search.h"

namespace poselift {

struct MotionReconstructionOptions {
  int num_neighbours = 50;  // K, taken of the segments that the search finds
  // What a metre between the observed points and a neighbour's counts in its
  // distance, beside the weighted features: 1 / (5 cm). With 0 the neighbours
  // are chosen by the last poses alone, as in the paper.
  double observed_scale_per_m = 20.0;
  LocalRegressionOptions regression{.method = LocalRegressionMethod::kMean,
                                    .target = RegressionTarget::kChange,
                                    .velocity_scale = 0.0};
  // The regression's standard deviations are multiplied by this: they are those
  // of one step from captured poses, the poses it looks back on are not.
  double prior_sigma_factor = 3.0;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// Data-driven motion reconstruction using local regression models (Mousas,
// Newbury and Anagnostopoulos 2014). At each frame the segments of a database
// nearest to the last m poses give a Gaussian of the next pose (Eq. (10)), and
// the answer is
//   argmin_q  sum_k |m_k f(q) - c_k|^2 / sigma_k^2 + |whitening delta(q)|^2   Eq. (2), (11)
// by Levenberg-Marquardt from the mean of that Gaussian. Ours: what is observed
// helps to choose and weigh the neighbours, by where their next pose has it.
class MotionReconstruction : public MotionMethod {
 public:
  // The search, over the segments of the database, finds the candidates. Both
  // must outlive this. Throws InputError when the options are invalid.
  MotionReconstruction(const MotionDatabase& database, const SegmentSearch& search,
                       const MotionReconstructionOptions& options = {});

  // At least m + 1 poses. Throws std::invalid_argument for fewer.
  void Begin(const std::vector<SkeletonPose>& first) override;
  SkeletonPose Next(const std::vector<TargetPoint>& observed) override;

 private:
  // p(q_t | c_t, the last m poses) without the likelihood.
  void Predict(const std::vector<TargetPoint>& observed);
  void Gather(const std::vector<TargetPoint>& observed);
  void KeepNearest();

  const MotionDatabase& database_;
  const SegmentSearch& search_;
  MotionReconstructionOptions options_;
  Articulation body_;
  LocalRegression regression_;
  SearchCursor cursor_;
  std::vector<SegmentMatch> matches_;
  std::vector<SkeletonPose> past_;  // m + 1, the oldest first
  // Inputs and outputs of the candidates, then of the neighbours.
  Eigen::MatrixXd x_, y_;
  Eigen::VectorXd query_;
  LocalPrediction local_;
  PosePrediction prediction_;
};

}  // namespace poselift
