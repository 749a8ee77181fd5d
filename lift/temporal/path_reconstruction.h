// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lift/ik/articulation.h"
#include "lift/temporal/motion_database.h"
#include "lift/temporal/motion_method.h"
#include "lift/temporal/path_search.h"
#include "lift/temporal/pose_prediction.h"

namespace poselift {

struct PathReconstructionOptions {
  double bandwidth = 0.35;  // of Eq. (7), times the distance of the farthest neighbour
  double shrinkage = 0.1;   // correlations are multiplied by 1 - shrinkage
  // The deviations of the neighbours' changes are multiplied by this: they are those
  // of one step from captured poses, the last pose is not.
  double change_sigma_factor = 6.0;
  double least_stddev = 1e-4;  // in the units of the features

  std::string Validate() const;  // empty, or which option is wrong and why
};

// The motion paper's model, Eq. (2), with neighbours that came along the path of
// the observed points (PathSearch) instead of those like the last reconstructed
// poses. What is observed is true and the last poses are not: a reconstruction
// that has gone astray finds other neighbours. With E_k of the neighbours in the place of
// the squared distance, Eq. (7) is
//   omega_k = exp(-(E_k - min E) / (2 h^2)),   h^2 = bandwidth^2 max E,  of sum 1.
// Aligned with the observed path, each neighbour says where the whole body is, root
// and heading included, and how it has just moved. Both say where q_t is,
//   p_A = N(mean of poses q_k, S_A)   p_B = N(q_{t-1} + mean of changes d_k, f^2 S_B),
// without a regression on the last poses, whose errors it would carry on. S: the
// weighted covariance of the neighbours, each about the mean of the others,
// correlations shrunk. Their product is the prior; Levenberg-Marquardt from its
// mean gives
//   argmin_q  sum_i |m_i f(q) - c_i|^2 / sigma_i^2 - ln p_A(q) - ln p_B(q).
// Causal; the time of a frame does not grow.
class PathReconstruction : public MotionMethod {
 public:
  // Both must outlive this. Throws InputError when the options are invalid.
  PathReconstruction(const MotionDatabase& database, const PathSearch& search,
                     const PathReconstructionOptions& options = {});

  // At least two poses. Throws std::invalid_argument for fewer.
  void Begin(const std::vector<SkeletonPose>& first) override;
  // The same points each time, or others: where they were before is then where
  // the reconstruction has them. Throws std::invalid_argument before Begin.
  SkeletonPose Next(const std::vector<TargetPoint>& observed) override;

 private:
  void Follow(const std::vector<TargetPoint>& observed);
  void Predict();
  void SetNeighbours();

  const MotionDatabase& database_;
  const PathSearch& search_;
  PathReconstructionOptions options_;
  Articulation body_;
  std::vector<SkeletonPose> past_;  // the oldest first
  std::vector<std::vector<Landmark::Part>> parts_;
  std::optional<PointPaths> paths_;  // of parts_
  PathQuery query_;
  std::vector<PathMatch> matches_;
  // A column a neighbour. Velocities are in the heading of the last pose.
  Eigen::MatrixXd poses_, changed_;
  Eigen::VectorXd weights_;
  PosePrediction prediction_;
};

}  // namespace poselift
