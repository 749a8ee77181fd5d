// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/feature_points.h"

#include <cmath>
#include <utility>

namespace poselift {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d Cross(const Vector3d& v) {
  Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

// Exp(v + dv) = Exp(J dv) Exp(v).
Matrix3d LeftJacobian(const Vector3d& v) {
  const double angle = v.norm();
  if (angle < 1e-6) return Matrix3d::Identity() + 0.5 * Cross(v);
  const Matrix3d axis = Cross(v / angle);
  return Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle * axis +
         (1.0 - std::sin(angle) / angle) * axis * axis;
}

}  // namespace

void FeaturePoints::Observe(const SkeletonPose& before, std::vector<TargetPoint> points) {
  before_ = before;
  points_ = std::move(points);
}

void FeaturePoints::PlaceBody(const SkeletonPose& pose) {
  ForwardKinematics(body_.skeleton, pose, &frames_);
  joints_m_ = JointPositions(body_.sites, frames_);
}

double FeaturePoints::SquaredMisses_m2(const FeatureVector& features) {
  PlaceBody(PoseFromFeatures(features, before_, frame_time_s_));
  double sum_m2 = 0.0;
  for (const TargetPoint& point : points_)
    sum_m2 += (SumOfJoints(point.parts, joints_m_) - point.x).squaredNorm();
  return sum_m2;
}

void FeaturePoints::Evaluate(const FeatureVector& features, Eigen::Ref<Eigen::VectorXd> residuals,
                             Eigen::MatrixXd* by_features) {
  const SkeletonPose pose = PoseFromFeatures(features, before_, frame_time_s_);
  PlaceBody(pose);
  for (size_t i = 0; i < points_.size(); ++i)
    residuals.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        points_[i].root_weight * (SumOfJoints(points_[i].parts, joints_m_) - points_[i].x);
  if (!by_features) return;
  JointJacobian(body_.skeleton, body_.sites, pose, frames_, &joint_jacobian_);
  by_pose_.setZero(num_rows(), joint_jacobian_.cols());
  for (size_t i = 0; i < points_.size(); ++i)
    for (const Landmark::Part& part : points_[i].parts)
      by_pose_.middleRows<3>(3 * static_cast<Eigen::Index>(i)) +=
          points_[i].root_weight * part.weight * joint_jacobian_.middleRows<3>(3 * part.joint);
  DifferentiatePose(features);
  by_features->noalias() = by_pose_ * pose_by_features_;
}

void FeaturePoints::DifferentiatePose(const FeatureVector& features) {
  const double dt = frame_time_s_;
  const double yaw_rad = Yaw(before_.world_from_root) + features[feature::kYawRate] * dt;
  const Matrix3d world_from_heading =
      Eigen::AngleAxisd(yaw_rad, Vector3d::UnitY()).toRotationMatrix();
  const Vector3d step_in_world_m =
      world_from_heading *
      Vector3d(features[feature::kVelocity] * dt, 0.0, features[feature::kVelocity + 1] * dt);
  const Vector3d tilt(features[feature::kTilt], 0.0, features[feature::kTilt + 1]);
  const Matrix3d turn_by_tilt = world_from_heading * LeftJacobian(tilt);

  auto& m = pose_by_features_;
  m.setZero();
  m.bottomLeftCorner<kNumAngles, kNumAngles>().setIdentity();
  m.col(feature::kHeight)[1] = 1.0;
  m.col(feature::kTilt).segment<3>(3) = turn_by_tilt.col(0);
  m.col(feature::kTilt + 1).segment<3>(3) = turn_by_tilt.col(2);
  m.col(feature::kVelocity).head<3>() = dt * world_from_heading.col(0);
  m.col(feature::kVelocity + 1).head<3>() = dt * world_from_heading.col(2);
  m.col(feature::kYawRate).head<3>() = dt * Vector3d::UnitY().cross(step_in_world_m);
  m.col(feature::kYawRate)[4] = dt;
}

}  // namespace poselift
