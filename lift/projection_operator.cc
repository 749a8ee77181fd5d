// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/projection_operator.h"

#include <algorithm>
#include <iterator>

namespace poselift {

ProjectionOperator::ProjectionOperator(const Observation& observation) {
  std::vector<const ObservedPoint*> points;
  for (const ObservedPoint& point : observation.points)
    if (point.kind == ObservedPoint::Kind::k2D) points.push_back(&point);
  num_2d_ = static_cast<int>(points.size());
  for (const ObservedPoint& point : observation.points)
    if (point.kind == ObservedPoint::Kind::k3D) points.push_back(&point);

  const auto num_points = static_cast<Eigen::Index>(points.size());
  num_3d_ = static_cast<int>(num_points) - num_2d_;
  const std::vector<JointRelation>& relations = observation.relations;
  const auto num_columns = num_points + std::ssize(relations);
  landmark_from_joint_.setZero(num_columns, kNumJoints);
  weights_.resize(num_columns);
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, num_columns);
  for (Eigen::Index i = 0; i < num_points; ++i) {
    for (const auto& [joint, weight] : points[i]->parts) landmark_from_joint_(i, joint) += weight;
    weights_[i] = 1.0 / points[i]->sigma;
    x.col(i) = points[i]->x;
  }
  axes_in_cam_.resize(3, std::ssize(relations));
  for (Eigen::Index i = 0; i < axes_in_cam_.cols(); ++i) {
    const JointRelation& relation = relations[static_cast<size_t>(i)];
    for (const auto& [joint, weight] : relation.parts)
      landmark_from_joint_(num_points + i, joint) += weight;
    weights_[num_points + i] = 1.0 / relation.sigma_m;
    axes_in_cam_.col(i) = relation.axis_in_cam;
    is_lower_bound_.push_back(relation.is_lower_bound);
  }
  if (std::find(is_lower_bound_.begin(), is_lower_bound_.end(), true) == is_lower_bound_.end())
    is_lower_bound_.clear();
  if (num_2d_ > 0) {
    const auto squared = weights_.head(num_2d_).cwiseAbs2();
    weighted_mean_px_ = (x.topLeftCorner(2, num_2d_) * squared) / squared.sum();
  }
  Eigen::Matrix3Xd weighted = x * weights_.asDiagonal();
  Centre(weighted);
  target_ = Rows(Eigen::Matrix3d::Identity(), 1.0, weighted);
  for (Eigen::Index i = 0; i < axes_in_cam_.cols(); ++i)
    target_[NumPointRows() + i] =
        weights_[num_points + i] * relations[static_cast<size_t>(i)].bound_m;
}

// Takes the part along w out of each coordinate of the 2D and of the 3D points.
void ProjectionOperator::Centre(Eigen::Ref<Eigen::Matrix3Xd> weighted_points) const {
  const auto centre = [&](Eigen::Index first, Eigen::Index count) {
    if (count == 0) return;
    const auto w = weights_.segment(first, count);
    auto block = weighted_points.middleCols(first, count);
    const Eigen::Vector3d along = block * w / w.squaredNorm();
    block.noalias() -= along * w.transpose();
  };
  centre(0, num_2d_);
  centre(num_2d_, num_3d_);
}

Eigen::Matrix3Xd ProjectionOperator::CentredPoints(
    const Eigen::Ref<const Eigen::VectorXd>& pose_in_body) const {
  const Eigen::Map<const Eigen::Matrix3Xd> joints(pose_in_body.data(), 3, kNumJoints);
  Eigen::Matrix3Xd points = joints * landmark_from_joint_.transpose() * weights_.asDiagonal();
  Centre(points);
  return points;
}

Eigen::MatrixXd ProjectionOperator::CentredPointsOfAll(const Eigen::MatrixXd& atoms) const {
  Eigen::MatrixXd points(3 * NumPoints(), atoms.cols());
  for (Eigen::Index k = 0; k < atoms.cols(); ++k)
    Eigen::Map<Eigen::Matrix3Xd>(points.col(k).data(), 3, NumPoints()) =
        CentredPoints(atoms.col(k));
  return points;
}

Eigen::VectorXd ProjectionOperator::Rows(
    const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
    const Eigen::Ref<const Eigen::Matrix3Xd>& centred_points) const {
  Eigen::VectorXd rows(NumPointRows() + axes_in_cam_.cols());
  Eigen::Map<Eigen::Matrix2Xd>(rows.data(), 2, num_2d_).noalias() =
      scale_px_per_m * cam_from_body.topRows<2>() * centred_points.leftCols(num_2d_);
  Eigen::Map<Eigen::Matrix3Xd>(rows.data() + 2 * num_2d_, 3, num_3d_).noalias() =
      cam_from_body * centred_points.middleCols(num_2d_, num_3d_);
  for (Eigen::Index i = 0; i < axes_in_cam_.cols(); ++i)
    rows[NumPointRows() + i] =
        axes_in_cam_.col(i).dot(cam_from_body * centred_points.col(num_2d_ + num_3d_ + i));
  return rows;
}

Eigen::VectorXd ProjectionOperator::Residual(
    const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
    const Eigen::Ref<const Eigen::Matrix3Xd>& centred_points) const {
  Eigen::VectorXd residual = Rows(cam_from_body, scale_px_per_m, centred_points) - target_;
  LetGoOfBounds(residual);
  return residual;
}

bool ProjectionOperator::IsBound(Eigen::Index row) const {
  return HasLowerBounds() && row >= NumPointRows() &&
         is_lower_bound_[static_cast<size_t>(row - NumPointRows())];
}

void ProjectionOperator::LetGoOfBounds(Eigen::Ref<Eigen::VectorXd> residual) const {
  for (Eigen::Index row = NumPointRows(); row < residual.size(); ++row)
    if (IsBound(row)) residual[row] = std::min(0.0, residual[row]);
}

Eigen::ArrayXd ProjectionOperator::ActiveRows(const Eigen::VectorXd& residual) const {
  Eigen::ArrayXd active = Eigen::ArrayXd::Ones(residual.size());
  for (Eigen::Index row = NumPointRows(); row < residual.size(); ++row)
    if (IsBound(row) && !(residual[row] < 0.0)) active[row] = 0.0;
  return active;
}

Eigen::VectorXd ProjectionOperator::Apply(
    const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
    const Eigen::Ref<const Eigen::VectorXd>& pose_in_body) const {
  return Rows(cam_from_body, scale_px_per_m, CentredPoints(pose_in_body));
}

Eigen::VectorXd ProjectionOperator::Adjoint(const Eigen::Matrix3d& cam_from_body,
                                            double scale_px_per_m,
                                            const Eigen::Ref<const Eigen::VectorXd>& rows) const {
  const Eigen::Map<const Eigen::Matrix2Xd> rows_2d(rows.data(), 2, num_2d_);
  const Eigen::Map<const Eigen::Matrix3Xd> rows_3d(rows.data() + 2 * num_2d_, 3, num_3d_);
  Eigen::Matrix3Xd points(3, NumPoints());
  points.leftCols(num_2d_) = scale_px_per_m * cam_from_body.topRows<2>().transpose() * rows_2d;
  points.middleCols(num_2d_, num_3d_) = cam_from_body.transpose() * rows_3d;
  for (Eigen::Index i = 0; i < axes_in_cam_.cols(); ++i)
    points.col(num_2d_ + num_3d_ + i) =
        rows[NumPointRows() + i] * (cam_from_body.transpose() * axes_in_cam_.col(i));
  Centre(points);
  const Pose3 joints = points * weights_.asDiagonal() * landmark_from_joint_;
  return Stacked(joints);
}

void ProjectionOperator::ApplyToAll(const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
                                    const Eigen::MatrixXd& centred_points,
                                    Eigen::Ref<Eigen::MatrixXd> rows) const {
  const Eigen::Matrix<double, 2, 3> px_from_body = scale_px_per_m * cam_from_body.topRows<2>();
  const Eigen::Matrix3Xd axes_in_body = cam_from_body.transpose() * axes_in_cam_;
  for (Eigen::Index k = 0; k < centred_points.cols(); ++k) {
    const double* point = centred_points.col(k).data();
    double* row = rows.col(k).data();
    for (int i = 0; i < num_2d_; ++i, point += 3, row += 2)
      Eigen::Map<Eigen::Vector2d>(row).noalias() =
          px_from_body * Eigen::Map<const Eigen::Vector3d>(point);
    for (int i = 0; i < num_3d_; ++i, point += 3, row += 3)
      Eigen::Map<Eigen::Vector3d>(row).noalias() =
          cam_from_body * Eigen::Map<const Eigen::Vector3d>(point);
    for (Eigen::Index i = 0; i < axes_in_cam_.cols(); ++i, point += 3, ++row)
      *row = axes_in_body.col(i).dot(Eigen::Map<const Eigen::Vector3d>(point));
  }
}

double ProjectionOperator::BestScale_px_per_m(
    const Eigen::Matrix3d& cam_from_body, const Eigen::Ref<const Eigen::Matrix3Xd>& centred_points,
    double fallback_px_per_m) const {
  const Eigen::VectorXd unscaled = Rows(cam_from_body, 1.0, centred_points).head(2 * num_2d_);
  const double squared = unscaled.squaredNorm();
  if (!(squared > 0.0)) return fallback_px_per_m;
  const double scale = unscaled.dot(target_.head(2 * num_2d_)) / squared;
  return scale > 0.0 ? scale : fallback_px_per_m;
}

Eigen::Vector2d ProjectionOperator::Translation_px(
    const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
    const Eigen::Ref<const Eigen::VectorXd>& pose_in_body) const {
  if (num_2d_ == 0) return Eigen::Vector2d::Zero();
  const Eigen::Map<const Eigen::Matrix3Xd> joints(pose_in_body.data(), 3, kNumJoints);
  const auto squared = weights_.head(num_2d_).cwiseAbs2();
  const Eigen::Vector3d mean_in_body =
      joints * (landmark_from_joint_.topRows(num_2d_).transpose() * squared) / squared.sum();
  return weighted_mean_px_ - scale_px_per_m * (cam_from_body.topRows<2>() * mean_in_body);
}

}  // namespace poselift
