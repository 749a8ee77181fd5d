// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>

#include "lift/ik/articulation.h"
#include "src/camera.h"
#include "src/tag_detection.h"

namespace ceres {
class CostFunction;
}

namespace poselift {

using TagCorners = Eigen::Matrix<double, 2, 4>;

// A tag on a bone, as a camera freed of its lens distortion sees it. Corner i, c_i in the tag's
// frame, is where the pose q has it:
//
//   x_i(q) = cam_from_world (start(q) + G(q) (R c_i + t)),   (R, t) = bone_from_tag,
//   p_i    = (x_i / z_i, y_i / z_i),
//   r(q)   = W [focal (1 + k1 |p_i|^2) p_i - corner_i],      8 rows,
//
// with corners in pixels from the principal point. W^T W is the inverse of their
// covariance, that of the noise and of how loosely the tag sits: TagWhitening.
struct TagInPicture {
  int bone = 0;
  Eigen::Isometry3d bone_from_tag = Eigen::Isometry3d::Identity();  // metres
  double size_m = 0.0;
  TagCorners corners_px = TagCorners::Zero();
  Eigen::Matrix<double, 8, 8> whitening = Eigen::Matrix<double, 8, 8>::Identity();
};

struct TagView {
  double focal_px = 0.0;
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();
  double k1 = 0.0;  // of a lens that is still to be found
};

// What a self-calibrated camera has to be found: log(focal / focal_px), k1 (camera.h).
using LensVector = Eigen::Vector2d;
TagView WithLens(TagView view, const LensVector& lens);

// Corners as that view has them: freed of the lens, from the principal point, at focal length
// fx_px. NaN where the lens shows nothing.
TagCorners CornersWithoutLens(const Camera& camera, const TagCorners& corners_px);

// Of x and of y of a corner, given that of corners where edges meet (TagDetection).
double CornerSigma_px(const TagDetection& tag, double refined_sigma_px);

// W with W^T W the inverse of a covariance.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> InverseRoot(
    const Eigen::Matrix<double, kSize, kSize>& covariance) {
  using Square = Eigen::Matrix<double, kSize, kSize>;
  const Square lower = covariance.llt().matrixL();
  return lower.template triangularView<Eigen::Lower>().solve(Square::Identity());
}

// Where the corners are seen, NaN when one is not before the camera.
TagCorners ProjectTag(const TagView& view, const Eigen::Isometry3d& cam_from_tag, double size_m);

// How little corners say.
struct TagSigmas {
  double corner_px = 0.15;
  double mount_m = 0.0, mount_rad = 0.0;  // how the tag sits on its bone
  // Of a camera whose focal length is a guess: the share of its distance by which a tag's depth
  // behind the body's may be off. All its corners are then off by that share of their distance
  // from the principal point.
  double depth = 0.0;
};
// Of a body 3 m away, whose parts lie within half a metre of depth, and a guess 20 % off; of weak
// perspective, which sees no depth at all.
inline constexpr double kGuessedDepthSigma = 0.03, kWeakDepthSigma = 0.1;

// The inverse square root of
//   corner^2 I + J diag(mount_m^2, mount_rad^2) J^T + depth^2 c c^T,
// J by small shifts and turns of the tag where it is, c its corners from the principal point.
Eigen::Matrix<double, 8, 8> TagWhitening(const TagView& view, const Eigen::Isometry3d& cam_from_tag,
                                         double size_m, const TagSigmas& sigmas);

// Parameter blocks as in pose_costs.h: root_in_world_m, world_from_root, dofs. A corner
// behind the camera fails the evaluation.
std::unique_ptr<ceres::CostFunction> MakeTagCost(const Articulation& body, const TagView& view,
                                                 const TagInPicture& tag);

// The same with where the tag sits, the lengths of the bones and the lens as further
// unknowns: behind its blocks come t (3), R (a unit quaternion x y z w), the kNumBoneGroups
// log ratios to the lengths of `standard` (body_proportions.h), whose bones end at the
// joints, and LensVector.
std::unique_ptr<ceres::CostFunction> MakeTagFitCost(const Articulation& standard,
                                                    const TagView& view, const TagInPicture& tag);

// W (x_bone(q) - x): a point of a bone, measured in space with a covariance.
struct PointInSpace {
  int bone = 0;
  Eigen::Vector3d x_in_bone_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d x_in_world_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d whitening = Eigen::Matrix3d::Identity();
};
std::unique_ptr<ceres::CostFunction> MakePointCost(const Articulation& body,
                                                   const PointInSpace& point);

}  // namespace poselift
