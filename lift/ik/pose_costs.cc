// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/ik/pose_costs.h"

#include <ceres/cost_function.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lift/ik/rotation_derivative.h"
#include "src/forward_kinematics.h"

namespace poselift {
namespace {

using RowMajorMap =
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

// What the terms of f(q) share: reading the blocks, forward kinematics, and
// writing the Jacobian block by block.
class ArticulatedCost : public ceres::CostFunction {
 protected:
  ArticulatedCost(const Articulation& body, std::vector<TargetPoint> points, int rows_a_point)
      : points_(std::move(points)), body_(body) {
    pose_.dofs.setZero(body.num_dofs);
    set_num_residuals(rows_a_point * static_cast<int>(points_.size()));
    *mutable_parameter_block_sizes() = {3, 4, body.num_dofs};
  }

  // The points m_i f(q) of the blocks' pose and, if wanted, the joints' Jacobian.
  void PosePoints(double const* const* parameters, bool with_jacobian) const {
    pose_.root_in_world_m = Eigen::Map<const Eigen::Vector3d>(parameters[0]);
    pose_.world_from_root.coeffs() = Eigen::Map<const Eigen::Vector4d>(parameters[1]);
    pose_.dofs = Eigen::Map<const Eigen::VectorXd>(parameters[2], body_.num_dofs);
    ForwardKinematics(body_.skeleton, pose_, &frames_);
    const Pose3 joints_m = JointPositions(body_.sites, frames_);
    posed_m_.resize(3, points_.size());
    for (size_t i = 0; i < points_.size(); ++i)
      posed_m_.col(i) = SumOfJoints(points_[i].parts, joints_m);
    if (with_jacobian) JointJacobian(body_.skeleton, body_.sites, pose_, frames_, &joint_jacobian_);
  }

  // by_pose_: residuals by the columns of JointJacobian, from the first
  // coordinates of each point times a factor.
  template <int kRowsAPoint>
  void DifferentiateByPose(double factor) const {
    by_pose_.setZero(num_residuals(), joint_jacobian_.cols());
    for (size_t i = 0; i < points_.size(); ++i)
      for (const Landmark::Part& part : points_[i].parts)
        by_pose_.middleRows<kRowsAPoint>(kRowsAPoint * i) +=
            factor * points_[i].root_weight * part.weight *
            joint_jacobian_.middleRows<kRowsAPoint>(3 * part.joint);
  }

  // The same, a row a point: along its x.
  void DifferentiateAlongAxes() const {
    by_pose_.setZero(num_residuals(), joint_jacobian_.cols());
    for (size_t i = 0; i < points_.size(); ++i)
      for (const Landmark::Part& part : points_[i].parts)
        by_pose_.row(static_cast<Eigen::Index>(i)) +=
            points_[i].root_weight * part.weight *
            (points_[i].x.transpose() * joint_jacobian_.middleRows<3>(3 * part.joint));
  }

  void WritePoseJacobians(double** jacobians) const {
    const Eigen::Index rows = num_residuals();
    if (jacobians[0]) RowMajorMap(jacobians[0], rows, 3) = by_pose_.leftCols<3>();
    if (jacobians[1])
      RowMajorMap(jacobians[1], rows, 4).noalias() =
          by_pose_.middleCols<3>(3) * RotationByCoefficients(pose_.world_from_root);
    if (jacobians[2])
      RowMajorMap(jacobians[2], rows, body_.num_dofs) = by_pose_.rightCols(body_.num_dofs);
  }

  const std::vector<TargetPoint> points_;
  // Of the latest evaluation.
  mutable Eigen::Matrix3Xd posed_m_;
  mutable Eigen::MatrixXd by_pose_;
  const Articulation& body_;
  mutable SkeletonPose pose_;
  mutable BoneFrames frames_;

 private:
  mutable Eigen::MatrixXd joint_jacobian_;
};

// The rotation vector, at most half a turn long.
Eigen::Vector3d LogOf(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

// How log(R Exp(w)) changes with w at 0: the inverse of the right Jacobian at log R.
Eigen::Matrix3d LogByTurn(const Eigen::Vector3d& log) {
  const double angle = log.norm();
  constexpr double kSmall = 1e-4;
  const double c =
      angle < kSmall ? 1.0 / 12.0 : 1.0 / (angle * angle) - 0.5 / (angle * std::tan(0.5 * angle));
  const Eigen::Matrix3d cross = Cross(log);
  return Eigen::Matrix3d::Identity() + 0.5 * cross + c * cross * cross;
}

// A tag with its bone looked up.
struct Tag {
  int bone;
  Eigen::Isometry3d bone_from_tag, world_from_tag;
  double per_m, per_rad;  // 1 / sigma
};

std::vector<Tag> FindTags(const Articulation& body,
                          const std::vector<ObservedBonePose>& bone_poses) {
  std::vector<Tag> tags;
  for (const ObservedBonePose& pose : bone_poses) {
    const auto bone = body.skeleton.FindBone(pose.bone);
    if (!bone)
      throw std::invalid_argument("tag " + pose.name + ": the skeleton has no bone " + pose.bone);
    if (!(pose.sigma_m > 0.0 && pose.sigma_rad > 0.0 && pose.bone_from_tag.matrix().allFinite() &&
          pose.cam_from_tag.matrix().allFinite()))
      throw std::invalid_argument("tag " + pose.name +
                                  ": poses are finite, their sigmas more than 0");
    tags.push_back(
        {*bone, pose.bone_from_tag, pose.cam_from_tag, 1.0 / pose.sigma_m, 1.0 / pose.sigma_rad});
  }
  return tags;
}

class SpaceCost final : public ArticulatedCost {
 public:
  SpaceCost(const Articulation& body, std::vector<TargetPoint> points, std::vector<Tag> tags,
            bool up_to_translation)
      : ArticulatedCost(body, std::move(points), 3),
        tags_(std::move(tags)),
        up_to_translation_(up_to_translation) {
    for (const TargetPoint& point : points_) place_weights_.push_back(point.root_weight);
    for (const Tag& tag : tags_) place_weights_.push_back(tag.per_m);
    set_num_residuals(NumPlaceRows() + 3 * static_cast<int>(tags_.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    PosePoints(parameters, jacobians != nullptr);
    Eigen::Map<Eigen::Matrix3Xd> rows(residuals, 3, num_residuals() / 3);
    for (size_t i = 0; i < points_.size(); ++i)
      rows.col(i) = points_[i].root_weight * (posed_m_.col(i) - points_[i].x);
    if (jacobians) DifferentiateByPose<3>(1.0);
    for (size_t k = 0; k < tags_.size(); ++k) EvaluateTag(k, jacobians != nullptr, rows);
    if (up_to_translation_) Centre(rows);
    if (!jacobians) return true;
    if (up_to_translation_)
      for (auto column : by_pose_.colwise())
        Centre(Eigen::Map<Eigen::Matrix3Xd>(column.data(), 3, num_residuals() / 3));
    WritePoseJacobians(jacobians);
    return true;
  }

 private:
  int NumPlaceRows() const { return 3 * static_cast<int>(place_weights_.size()); }

  void EvaluateTag(size_t k, bool with_jacobian, Eigen::Map<Eigen::Matrix3Xd> rows) const {
    const Tag& tag = tags_[k];
    const Eigen::Matrix3d& world_from_bone = frames_.world_from_bone[tag.bone];
    const Eigen::Vector3d x_m =
        frames_.start_in_world_m.col(tag.bone) + world_from_bone * tag.bone_from_tag.translation();
    const Eigen::Matrix3d R = world_from_bone * tag.bone_from_tag.linear();
    const Eigen::Vector3d log = LogOf(tag.world_from_tag.linear().transpose() * R);
    const size_t place = points_.size() + k, turn = place_weights_.size() + k;
    rows.col(place) = tag.per_m * (x_m - tag.world_from_tag.translation());
    rows.col(turn) = tag.per_rad * log;
    if (!with_jacobian) return;
    FrameJacobian(body_.skeleton, tag.bone, x_m, pose_, frames_, &frame_jacobian_);
    by_pose_.middleRows<3>(3 * place) = tag.per_m * frame_jacobian_.topRows<3>();
    by_pose_.middleRows<3>(3 * turn).noalias() =
        (tag.per_rad * LogByTurn(log) * R.transpose()) * frame_jacobian_.bottomRows<3>();
  }

  // Of rows r_i = u_i d_i of place with root weights u_i, takes u_i times the
  // weighted mean of the d off each.
  void Centre(Eigen::Map<Eigen::Matrix3Xd> rows) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total_weight = 0.0;
    for (size_t i = 0; i < place_weights_.size(); ++i) {
      sum += place_weights_[i] * rows.col(i);
      total_weight += place_weights_[i] * place_weights_[i];
    }
    for (size_t i = 0; i < place_weights_.size(); ++i)
      rows.col(i) -= place_weights_[i] * (sum / total_weight);
  }

  std::vector<Tag> tags_;
  std::vector<double> place_weights_;  // of the points, then of the tags
  bool up_to_translation_;
  mutable Eigen::MatrixXd frame_jacobian_;
};

class ReprojectionCost final : public ArticulatedCost {
 public:
  ReprojectionCost(const Articulation& body, std::vector<TargetPoint> points)
      : ArticulatedCost(body, std::move(points), 2) {
    mutable_parameter_block_sizes()->push_back(3);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    PosePoints(parameters, jacobians != nullptr);
    const double scale_px_per_m = std::exp(parameters[3][0]);
    const Eigen::Vector2d translation_px(parameters[3][1], parameters[3][2]);
    for (size_t i = 0; i < points_.size(); ++i)
      Eigen::Map<Eigen::Vector2d>(residuals + 2 * i) =
          points_[i].root_weight *
          (scale_px_per_m * posed_m_.col(i).head<2>() + translation_px - points_[i].x.head<2>());
    if (!jacobians) return true;
    DifferentiateByPose<2>(scale_px_per_m);
    WritePoseJacobians(jacobians);
    if (jacobians[3])
      for (size_t i = 0; i < points_.size(); ++i)
        RowMajorMap(jacobians[3] + 6 * i, 2, 3)
            << points_[i].root_weight * scale_px_per_m * posed_m_.col(i).head<2>(),
            points_[i].root_weight * Eigen::Matrix2d::Identity();
    return true;
  }
};

std::vector<TargetPoint> PointsOf(const std::vector<JointRelation>& relations) {
  std::vector<TargetPoint> points;
  for (const JointRelation& relation : relations)
    points.push_back({relation.parts, relation.axis_in_cam, 1.0 / relation.sigma_m});
  return points;
}

// Its points are differences of joints, whose x is the axis.
class RelationCost final : public ArticulatedCost {
 public:
  RelationCost(const Articulation& body, std::vector<JointRelation> relations)
      : ArticulatedCost(body, PointsOf(relations), 3), relations_(std::move(relations)) {
    set_num_residuals(static_cast<int>(relations_.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    PosePoints(parameters, jacobians != nullptr);
    for (size_t i = 0; i < relations_.size(); ++i) {
      const JointRelation& relation = relations_[i];
      const double residual =
          (relation.axis_in_cam.dot(posed_m_.col(static_cast<Eigen::Index>(i))) -
           relation.bound_m) /
          relation.sigma_m;
      residuals[i] = relation.is_lower_bound ? std::min(0.0, residual) : residual;
    }
    if (!jacobians) return true;
    DifferentiateAlongAxes();
    for (size_t i = 0; i < relations_.size(); ++i)
      if (relations_[i].is_lower_bound && residuals[i] == 0.0)
        by_pose_.row(static_cast<Eigen::Index>(i)).setZero();
    WritePoseJacobians(jacobians);
    return true;
  }

 private:
  std::vector<JointRelation> relations_;
};

class PriorCost final : public ceres::CostFunction {
 public:
  PriorCost(const Articulation& body, const PosePrior& prior) : body_(body), prior_(prior) {
    set_num_residuals(static_cast<int>(prior.whitening.rows()));
    *mutable_parameter_block_sizes() = {body.num_dofs};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    pose_.dofs = Eigen::Map<const Eigen::VectorXd>(parameters[0], body_.num_dofs);
    ForwardKinematics(body_.skeleton, pose_, &frames_);
    const Pose3 joints_m = JointPositions(body_.sites, frames_);
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()).noalias() =
        prior_.whitening * (Stacked(joints_m) - prior_.mean_m);
    if (!jacobians || !jacobians[0]) return true;
    JointJacobian(body_.skeleton, body_.sites, pose_, frames_, &joint_jacobian_);
    RowMajorMap(jacobians[0], num_residuals(), body_.num_dofs).noalias() =
        prior_.whitening * joint_jacobian_.rightCols(body_.num_dofs);
    return true;
  }

 private:
  const Articulation& body_;
  const PosePrior& prior_;
  // Of the latest evaluation; the root stays at the origin.
  mutable SkeletonPose pose_;
  mutable BoneFrames frames_;
  mutable Eigen::MatrixXd joint_jacobian_;
};

class SpringCost final : public ceres::CostFunction {
 public:
  explicit SpringCost(const DofSprings& springs) : springs_(springs) {
    const int num_dofs = static_cast<int>(springs.rest.size());
    set_num_residuals(num_dofs);
    *mutable_parameter_block_sizes() = {num_dofs};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Index num_dofs = springs_.rest.size();
    const Eigen::Map<const Eigen::VectorXd> dofs(parameters[0], num_dofs);
    const Eigen::VectorXd excess = dofs - springs_.limits.Clamp(dofs);
    Eigen::Map<Eigen::VectorXd>(residuals, num_dofs) =
        springs_.pull * (dofs - springs_.rest) + springs_.stiffness * excess;
    if (!jacobians || !jacobians[0]) return true;
    RowMajorMap by_dofs(jacobians[0], num_dofs, num_dofs);
    by_dofs.setZero();
    for (Eigen::Index d = 0; d < num_dofs; ++d)
      by_dofs(d, d) = springs_.pull + (excess[d] == 0.0 ? 0.0 : springs_.stiffness);
    return true;
  }

 private:
  DofSprings springs_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> MakeSpaceCost(
    const Articulation& body, std::vector<TargetPoint> points, bool up_to_translation,
    const std::vector<ObservedBonePose>& bone_poses) {
  return std::make_unique<SpaceCost>(body, std::move(points), FindTags(body, bone_poses),
                                     up_to_translation);
}

std::unique_ptr<ceres::CostFunction> MakeReprojectionCost(const Articulation& body,
                                                          std::vector<TargetPoint> points) {
  return std::make_unique<ReprojectionCost>(body, std::move(points));
}

std::unique_ptr<ceres::CostFunction> MakeRelationCost(const Articulation& body,
                                                      std::vector<JointRelation> relations) {
  return std::make_unique<RelationCost>(body, std::move(relations));
}

std::unique_ptr<ceres::CostFunction> MakePriorCost(const Articulation& body,
                                                   const PosePrior& prior) {
  return std::make_unique<PriorCost>(body, prior);
}

std::unique_ptr<ceres::CostFunction> MakeSpringCost(const DofSprings& springs) {
  return std::make_unique<SpringCost>(springs);
}

}  // namespace poselift
