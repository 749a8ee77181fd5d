// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift/weak_camera.h"
#include "src/observation.h"
#include "src/pose3.h"

namespace poselift {

// P of the sparse coding paper, for any label set and any mixture of 2D and 3D
// observations. With M_i the joint weights of point i, y = stacked pose (metres,
// body frame), R = cam_from_body, s = px per metre, w_i = 1 / sigma_i:
//
//   2D point:  w_i ( s (R M_i y)_xy + t_px - x_i_px )     2 rows
//   3D point:  w_i (    R M_i y     + t_m  - x_i_m  )     3 rows
//
// The translations are no unknowns: what is left of the rows after the best
// translation is C v, where C takes the weighted mean of its kind (2D or 3D)
// away from every row. C is symmetric and C C = C; it commutes with R, so each
// pose is centred once. The rows of P y are C W (..) and those of the target
// likewise: x and y of each 2D point in their order, then x, y and z of each 3D
// point. The paper's P (0/1 on the diagonal, root shifted to the origin) is
// the case R M_i = one coordinate of one joint.
//
// Below them, a row for each relation of joints (joint_relation.h), whose weights sum to
// 0 and need no translation:
//
//   w_i ( a_i^T R M_i y - b_i )     1 row; of a lower bound only where that is below 0
class ProjectionOperator {
 public:
  explicit ProjectionOperator(const Observation& observation);

  // Relations are counted with the points: they have a column each.
  int NumPoints() const { return static_cast<int>(weights_.size()); }
  int NumRows() const { return static_cast<int>(target_.size()); }
  int Num2D() const { return num_2d_; }
  int Num3D() const { return num_3d_; }
  bool Has2D() const { return num_2d_ > 0; }
  bool Has3D() const { return num_3d_ > 0; }
  // Rows of points; those of the relations follow.
  int NumPointRows() const { return 2 * num_2d_ + 3 * num_3d_; }
  bool HasLowerBounds() const { return !is_lower_bound_.empty(); }

  // C W x, then w b: the target rows.
  const Eigen::VectorXd& target() const { return target_; }

  // The weighted, centred points w_i (M_i y - mean) of a pose, before rotation
  // and scale: 3 x NumPoints, 2D points first, relations last.
  Eigen::Matrix3Xd CentredPoints(const Eigen::Ref<const Eigen::VectorXd>& pose_in_body) const;
  // The same for every column of a dictionary: (3 NumPoints) x K.
  Eigen::MatrixXd CentredPointsOfAll(const Eigen::MatrixXd& atoms) const;

  // P y from the centred points: NumRows.
  Eigen::VectorXd Rows(const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
                       const Eigen::Ref<const Eigen::Matrix3Xd>& centred_points) const;
  // P y.
  Eigen::VectorXd Apply(const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
                        const Eigen::Ref<const Eigen::VectorXd>& pose_in_body) const;
  // P^T v: <Apply(y), v> = <y, Adjoint(v)> for all y and v.
  Eigen::VectorXd Adjoint(const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
                          const Eigen::Ref<const Eigen::VectorXd>& rows) const;

  // P y - target, 0 for bounds that hold.
  Eigen::VectorXd Residual(const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
                           const Eigen::Ref<const Eigen::Matrix3Xd>& centred_points) const;
  // Sets the rows of bounds that hold to 0.
  void LetGoOfBounds(Eigen::Ref<Eigen::VectorXd> residual) const;
  // 1, or 0 for the bounds of these that hold: NumRows.
  Eigen::ArrayXd ActiveRows(const Eigen::VectorXd& residual) const;

  // A_p: P applied to every column, from the columns' centred points
  // (3 NumPoints x K), into rows (NumRows x K).
  void ApplyToAll(const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
                  const Eigen::MatrixXd& centred_points, Eigen::Ref<Eigen::MatrixXd> rows) const;

  // The scale that suits a posed camera best: least squares over the 2D rows;
  // `fallback` where they leave it open.
  double BestScale_px_per_m(const Eigen::Matrix3d& cam_from_body,
                            const Eigen::Ref<const Eigen::Matrix3Xd>& centred_points,
                            double fallback_px_per_m) const;

  // The best translation of the 2D points for a posed camera, px.
  Eigen::Vector2d Translation_px(const Eigen::Matrix3d& cam_from_body, double scale_px_per_m,
                                 const Eigen::Ref<const Eigen::VectorXd>& pose_in_body) const;

 private:
  void Centre(Eigen::Ref<Eigen::Matrix3Xd> weighted_points) const;

  bool IsBound(Eigen::Index row) const;

  int num_2d_ = 0;  // points [0, num_2d_) are 2D, the num_3d_ behind them 3D
  int num_3d_ = 0;
  Eigen::MatrixXd landmark_from_joint_;  // NumPoints x 23
  Eigen::VectorXd weights_;              // 1 / sigma
  Eigen::VectorXd target_;
  Eigen::Vector2d weighted_mean_px_ = Eigen::Vector2d::Zero();
  // Of the relations.
  Eigen::Matrix3Xd axes_in_cam_;
  std::vector<bool> is_lower_bound_;  // empty when none is
};

}  // namespace poselift
