// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift/ik/articulation.h"
#include "lift/ik/pose_costs.h"
#include "lift/temporal/motion_features.h"

namespace poselift {

// Observed points of a body whose pose is told by its features, as the methods
// want it that model features by a subspace:
//
//   r_i(y) = root_weight_i (m_i f(q(y)) - x_i),   q(y) = PoseFromFeatures(y, before)
//
// 3 rows a point. Evaluation keeps its storage: for one thread at a time.
class FeaturePoints {
 public:
  // The body must outlive this.
  FeaturePoints(const Articulation& body, double frame_time_s)
      : body_(body), frame_time_s_(frame_time_s) {}

  // before: the pose of the frame before, of which only the root counts.
  void Observe(const SkeletonPose& before, std::vector<TargetPoint> points);

  int num_rows() const { return 3 * static_cast<int>(points_.size()); }
  // residuals: num_rows(). by_features: num_rows() x 46, or null.
  void Evaluate(const FeatureVector& features, Eigen::Ref<Eigen::VectorXd> residuals,
                Eigen::MatrixXd* by_features);
  // sum_i |m_i f(q(y)) - x_i|^2, without the weights.
  double SquaredMisses_m2(const FeatureVector& features);

 private:
  void PlaceBody(const SkeletonPose& pose);
  // dq/dy, 46 x 46: rows as the columns of JointJacobian, columns the features.
  void DifferentiatePose(const FeatureVector& features);

  const Articulation& body_;
  double frame_time_s_;
  SkeletonPose before_;
  std::vector<TargetPoint> points_;
  // Of the latest evaluation.
  BoneFrames frames_;
  Pose3 joints_m_;
  Eigen::MatrixXd joint_jacobian_, by_pose_;
  Eigen::Matrix<double, kNumFeatures, kNumFeatures> pose_by_features_;
};

}  // namespace poselift
