// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/tag_cost.h"

#include <ceres/cost_function.h>

#include <algorithm>
#include <cmath>

#include "lift/body_proportions.h"
#include "lift/ik/rotation_derivative.h"
#include "src/forward_kinematics.h"

namespace poselift {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;
template <int kRows>
using RowMajorMap = Eigen::Map<Eigen::Matrix<double, kRows, Eigen::Dynamic, Eigen::RowMajor>>;

constexpr double kNearest_m = 0.01;  // before the camera
constexpr double kHiddenEdgeSigma_px = 1.5;

Eigen::Vector2d Project(const TagView& view, const Eigen::Vector3d& x) {
  const Eigen::Vector2d p = x.hnormalized();
  return view.focal_px * (1.0 + view.k1 * p.squaredNorm()) * p;
}

Matrix23 ProjectionByPoint(const TagView& view, const Eigen::Vector3d& x) {
  const Eigen::Vector2d p = x.hnormalized();
  Matrix23 p_by_x;
  p_by_x << 1.0, 0.0, -p.x(), 0.0, 1.0, -p.y();
  return view.focal_px / x.z() *
         ((1.0 + view.k1 * p.squaredNorm()) * Eigen::Matrix2d::Identity() +
          2.0 * view.k1 * p * p.transpose()) *
         p_by_x;
}

// A pose's frames from the parameter blocks of pose_costs.h.
class BoneCost : public ceres::CostFunction {
 protected:
  BoneCost(const Articulation& body, int rows) : body_(&body) {
    pose_.dofs.setZero(body.num_dofs);
    set_num_residuals(rows);
    *mutable_parameter_block_sizes() = {3, 4, body.num_dofs};
  }

  void Pose(double const* const* parameters, const Skeleton& skeleton) const {
    pose_.root_in_world_m = Eigen::Map<const Eigen::Vector3d>(parameters[0]);
    pose_.world_from_root.coeffs() = Eigen::Map<const Eigen::Vector4d>(parameters[1]);
    pose_.dofs = Eigen::Map<const Eigen::VectorXd>(parameters[2], body_->num_dofs);
    ForwardKinematics(skeleton, pose_, &frames_);
  }

  // by_pose: residuals by root, a small turn of it, dofs.
  template <int kRows>
  void WritePose(const Eigen::Matrix<double, kRows, Eigen::Dynamic>& by_pose,
                 double** jacobians) const {
    if (jacobians[0]) RowMajorMap<kRows>(jacobians[0], kRows, 3) = by_pose.template leftCols<3>();
    if (jacobians[1])
      RowMajorMap<kRows>(jacobians[1], kRows, 4).noalias() =
          by_pose.template middleCols<3>(3) * RotationByCoefficients(pose_.world_from_root);
    if (jacobians[2])
      RowMajorMap<kRows>(jacobians[2], kRows, body_->num_dofs) = by_pose.rightCols(body_->num_dofs);
  }

  const Articulation* body_;
  mutable SkeletonPose pose_;
  mutable BoneFrames frames_;
  mutable Eigen::MatrixXd frame_jacobian_;
};

class TagCost final : public BoneCost {
 public:
  TagCost(const Articulation& body, const TagView& view, const TagInPicture& tag, bool fits)
      : BoneCost(body, 8), view_(view), tag_(tag), fits_(fits) {
    if (!fits_) return;
    for (const int size : {3, 4, kNumBoneGroups, 2})
      mutable_parameter_block_sizes()->push_back(size);
    fitted_ = body.skeleton;
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Eigen::Isometry3d bone_from_tag = tag_.bone_from_tag;
    TagView view = view_;
    if (fits_) {
      bone_from_tag.translation() = Eigen::Map<const Eigen::Vector3d>(parameters[3]);
      bone_from_tag.linear() =
          Eigen::Quaterniond(parameters[4][3], parameters[4][0], parameters[4][1], parameters[4][2])
              .toRotationMatrix();
      SetProportions(body_->skeleton, Eigen::Map<const GroupVector>(parameters[5]), &fitted_);
      view = WithLens(view_, Eigen::Map<const LensVector>(parameters[6]));
    }
    const Skeleton& skeleton = fits_ ? fitted_ : body_->skeleton;
    Pose(parameters, skeleton);
    const Eigen::Matrix3d& G = frames_.world_from_bone[static_cast<size_t>(tag_.bone)];
    const Eigen::Matrix<double, 3, 4> in_bone_m = bone_from_tag * TagCorners_m(tag_.size_m);
    const Eigen::Matrix<double, 3, 4> in_world_m =
        (G * in_bone_m).colwise() + frames_.start_in_world_m.col(tag_.bone);
    const Eigen::Matrix<double, 3, 4> in_cam_m = view_.cam_from_world * in_world_m;
    if (!(in_cam_m.row(2).minCoeff() > kNearest_m)) return false;
    Eigen::Map<Eigen::Matrix<double, 8, 1>> r(residuals);
    for (int i = 0; i < 4; ++i)
      r.segment<2>(2 * i) = Project(view, in_cam_m.col(i)) - tag_.corners_px.col(i);
    r = tag_.whitening * r;
    if (!jacobians) return true;

    const Eigen::Vector3d centre_m = in_world_m.rowwise().mean();
    FrameJacobian(skeleton, tag_.bone, centre_m, pose_, frames_, &frame_jacobian_);
    Eigen::Matrix<double, 8, Eigen::Dynamic> by_pose(8, frame_jacobian_.cols());
    Eigen::Matrix<double, 8, 3> by_world;  // by a shift of the tag in world
    Eigen::Matrix<double, 8, 3> by_turn;   // by a turn in the bone's frame
    for (int i = 0; i < 4; ++i) {
      const Matrix23 by_point =
          ProjectionByPoint(view, in_cam_m.col(i)) * view_.cam_from_world.linear();
      by_world.middleRows<2>(2 * i) = by_point;
      by_pose.middleRows<2>(2 * i).noalias() =
          by_point * (frame_jacobian_.topRows<3>() -
                      Cross(in_world_m.col(i) - centre_m) * frame_jacobian_.bottomRows<3>());
      by_turn.middleRows<2>(2 * i) =
          -by_point * G * Cross(in_bone_m.col(i) - bone_from_tag.translation());
    }
    by_world = (tag_.whitening * by_world).eval();
    WritePose<8>(tag_.whitening * by_pose, jacobians);
    if (!fits_) return true;
    WriteFit(by_world, tag_.whitening * by_turn, G, parameters[4], jacobians);
    if (jacobians[6]) WriteLens(view, in_cam_m, jacobians[6]);
    return true;
  }

 private:
  void WriteFit(const Eigen::Matrix<double, 8, 3>& by_world,
                const Eigen::Matrix<double, 8, 3>& by_turn, const Eigen::Matrix3d& G,
                const double* turn, double** jacobians) const {
    if (jacobians[3]) RowMajorMap<8>(jacobians[3], 8, 3) = by_world * G;
    if (jacobians[4])
      RowMajorMap<8>(jacobians[4], 8, 4) =
          by_turn * RotationByCoefficients(Eigen::Quaterniond(turn[3], turn[0], turn[1], turn[2]));
    if (!jacobians[5]) return;
    // A bone starts where its parent ends: the lengths from there to the root shift it.
    Eigen::Matrix<double, 3, kNumBoneGroups> start_by_ratios;
    start_by_ratios.setZero();
    for (int b = fitted_.bones[static_cast<size_t>(tag_.bone)].parent; b > 0;
         b = fitted_.bones[static_cast<size_t>(b)].parent)
      start_by_ratios.col(GroupOfJoint(b)) +=
          frames_.tip_in_world_m.col(b) - frames_.start_in_world_m.col(b);
    RowMajorMap<8>(jacobians[5], 8, kNumBoneGroups) = by_world * start_by_ratios;
  }

  void WriteLens(const TagView& view, const Eigen::Matrix<double, 3, 4>& in_cam_m,
                 double* jacobian) const {
    Eigen::Matrix<double, 8, 2> by_lens;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d p = in_cam_m.col(i).hnormalized();
      by_lens.middleRows<2>(2 * i) << Project(view, in_cam_m.col(i)),
          view.focal_px * p.squaredNorm() * p;
    }
    RowMajorMap<8>(jacobian, 8, 2) = tag_.whitening * by_lens;
  }

  TagView view_;
  TagInPicture tag_;
  bool fits_;
  mutable Skeleton fitted_;
};

class PointCost final : public BoneCost {
 public:
  PointCost(const Articulation& body, const PointInSpace& point)
      : BoneCost(body, 3), point_(point) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Pose(parameters, body_->skeleton);
    const Eigen::Vector3d x_m =
        frames_.start_in_world_m.col(point_.bone) +
        frames_.world_from_bone[static_cast<size_t>(point_.bone)] * point_.x_in_bone_m;
    Eigen::Map<Eigen::Vector3d> r(residuals);
    r = point_.whitening * (x_m - point_.x_in_world_m);
    if (!jacobians) return true;
    FrameJacobian(body_->skeleton, point_.bone, x_m, pose_, frames_, &frame_jacobian_);
    WritePose<3>(point_.whitening * frame_jacobian_.topRows<3>(), jacobians);
    return true;
  }

 private:
  PointInSpace point_;
};

}  // namespace

TagCorners CornersWithoutLens(const Camera& camera, const TagCorners& corners_px) {
  TagCorners without_px;
  for (int i = 0; i < 4; ++i)
    without_px.col(i) = camera.fx_px * camera.Undistort(corners_px.col(i)).head<2>();
  return without_px;
}

double CornerSigma_px(const TagDetection& tag, double refined_sigma_px) {
  return tag.is_refined ? refined_sigma_px : std::max(refined_sigma_px, kHiddenEdgeSigma_px);
}

TagView WithLens(TagView view, const LensVector& lens) {
  view.focal_px *= std::exp(lens[0]);
  view.k1 += lens[1];
  return view;
}

TagCorners ProjectTag(const TagView& view, const Eigen::Isometry3d& cam_from_tag, double size_m) {
  const Eigen::Matrix<double, 3, 4> in_cam_m = cam_from_tag * TagCorners_m(size_m);
  if (!(in_cam_m.row(2).minCoeff() > kNearest_m)) return TagCorners::Constant(std::nan(""));
  TagCorners corners_px;
  for (int i = 0; i < 4; ++i) corners_px.col(i) = Project(view, in_cam_m.col(i));
  return corners_px;
}

Eigen::Matrix<double, 8, 8> TagWhitening(const TagView& view, const Eigen::Isometry3d& cam_from_tag,
                                         double size_m, const TagSigmas& sigmas) {
  Eigen::Matrix<double, 8, 6> by_mount;
  const Eigen::Matrix<double, 3, 4> corners_m = TagCorners_m(size_m);
  for (int i = 0; i < 4; ++i) {
    const Matrix23 by_point =
        ProjectionByPoint(view, cam_from_tag * corners_m.col(i)) * cam_from_tag.linear();
    by_mount.middleRows<2>(2 * i) << sigmas.mount_m * by_point,
        -sigmas.mount_rad * by_point * Cross(corners_m.col(i));
  }
  Eigen::Matrix<double, 8, 8> covariance = by_mount * by_mount.transpose();
  covariance.diagonal().array() += sigmas.corner_px * sigmas.corner_px;
  if (sigmas.depth > 0.0) {
    const TagCorners corners_px = ProjectTag(view, cam_from_tag, size_m);
    const Eigen::Map<const Eigen::Matrix<double, 8, 1>> c(corners_px.data());
    covariance += sigmas.depth * sigmas.depth * c * c.transpose();
  }
  return InverseRoot<8>(covariance);
}

std::unique_ptr<ceres::CostFunction> MakeTagCost(const Articulation& body, const TagView& view,
                                                 const TagInPicture& tag) {
  return std::make_unique<TagCost>(body, view, tag, false);
}

std::unique_ptr<ceres::CostFunction> MakeTagFitCost(const Articulation& standard,
                                                    const TagView& view, const TagInPicture& tag) {
  return std::make_unique<TagCost>(standard, view, tag, true);
}

std::unique_ptr<ceres::CostFunction> MakePointCost(const Articulation& body,
                                                   const PointInSpace& point) {
  return std::make_unique<PointCost>(body, point);
}

}  // namespace poselift
