// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/motion_features.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "src/input_error.h"

namespace poselift {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Radians, the short way round.
double WithoutTurns(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

Quaterniond AboutY(double yaw_rad) {
  return Quaterniond(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitY()));
}

Vector2d Tilt(const Quaterniond& world_from_root, double yaw_rad) {
  const Quaterniond swing = AboutY(-yaw_rad) * world_from_root;
  const double length = swing.vec().norm();
  if (length == 0.0) return Vector2d::Zero();
  // of the two quaternions of a rotation, the one by less than pi
  const double sign = swing.w() < 0.0 ? -1.0 : 1.0;
  const double angle_rad = 2.0 * std::atan2(length, sign * swing.w());
  return sign * angle_rad / length * Vector2d(swing.x(), swing.z());
}

Quaterniond Swing(const Vector2d& tilt_rad) {
  const double angle_rad = tilt_rad.norm();
  if (angle_rad == 0.0) return Quaterniond::Identity();
  const Vector3d axis(tilt_rad.x() / angle_rad, 0.0, tilt_rad.y() / angle_rad);
  return Quaterniond(Eigen::AngleAxisd(angle_rad, axis));
}

void RequireFeatureSkeleton(const Skeleton& skeleton) {
  if (const std::string flaw = FeatureSkeletonFlaw(skeleton); !flaw.empty())
    throw InputError(skeleton.name, flaw);
}

}  // namespace

std::string FeatureSkeletonFlaw(const Skeleton& skeleton) {
  if (skeleton.bones.size() != kNumJoints || skeleton.NumDofs() != kNumAngles)
    return fmt::format(
        "found {} bones with {} degrees of freedom beside the root's, "
        "wanted the {} with {} of TrimToJoints",
        skeleton.bones.size(), skeleton.NumDofs(), kNumJoints, kNumAngles);
  for (const Bone& bone : skeleton.bones)
    for (const Dof& dof : bone.dofs)
      if (!dof.IsRotation())
        return "found a shift at the bone " + bone.name + ", wanted rotations alone";
  return "";
}

double Yaw(const Quaterniond& world_from_root) {
  return WithoutTurns(2.0 * std::atan2(world_from_root.y(), world_from_root.w()));
}

FeatureVector PoseFeatures(const SkeletonPose& pose) {
  FeatureVector features;
  features << pose.dofs, pose.root_in_world_m.y(),
      Tilt(pose.world_from_root, Yaw(pose.world_from_root)), Eigen::Vector3d::Zero();
  return features;
}

FeatureMatrix MotionFeatures(const Motion& motion) {
  RequireFeatureSkeleton(motion.skeleton);
  if (!(motion.frame_time_s > 0.0))
    throw InputError(
        fmt::format("found a frame time of {} s, wanted more than 0", motion.frame_time_s));
  FeatureMatrix features(kNumFeatures, static_cast<Eigen::Index>(motion.frames.size()));
  double yaw_before_rad = 0.0;
  for (Eigen::Index t = 0; t < features.cols(); ++t) {
    const SkeletonPose& pose = motion.frames[t];
    const double yaw_rad = Yaw(pose.world_from_root);
    auto column = features.col(t);
    column = PoseFeatures(pose);
    if (t > 0) {
      for (int d = 0; d < kNumAngles; ++d) {
        const double before_rad = features(d, t - 1);
        column[d] = before_rad + WithoutTurns(column[d] - before_rad);
      }
      const Vector3d step_in_world_m = pose.root_in_world_m - motion.frames[t - 1].root_in_world_m;
      const Vector3d step_m = AboutY(-yaw_rad) * step_in_world_m;
      column.segment<2>(feature::kVelocity) =
          Vector2d(step_m.x(), step_m.z()) / motion.frame_time_s;
      column[feature::kYawRate] = WithoutTurns(yaw_rad - yaw_before_rad) / motion.frame_time_s;
    }
    yaw_before_rad = yaw_rad;
  }
  if (features.cols() > 1) features.col(0).tail<3>() = features.col(1).tail<3>();
  return features;
}

SkeletonPose PoseFromFeatures(const FeatureVector& features, const SkeletonPose& before,
                              double frame_time_s) {
  const Quaterniond world_from_heading =
      AboutY(Yaw(before.world_from_root) + features[feature::kYawRate] * frame_time_s);
  const Vector2d step_m = features.segment<2>(feature::kVelocity) * frame_time_s;
  SkeletonPose pose;
  pose.root_in_world_m =
      before.root_in_world_m + world_from_heading * Vector3d(step_m.x(), 0.0, step_m.y());
  pose.root_in_world_m.y() = features[feature::kHeight];
  pose.world_from_root = world_from_heading * Swing(features.segment<2>(feature::kTilt));
  pose.dofs = features.head<kNumAngles>();
  return pose;
}

FeatureMatrix MirroredFeatures(const FeatureMatrix& features, const Skeleton& skeleton) {
  RequireFeatureSkeleton(skeleton);
  FeatureMatrix mirrored = features;
  const std::vector<int> starts = skeleton.DofStarts();
  for (int j = 0; j < kNumJoints; ++j) {
    const std::vector<Dof>& dofs = skeleton.bones[j].dofs;
    for (int i = 0; i < static_cast<int>(dofs.size()); ++i) {
      const double sign = dofs[i].Axis() == 0 ? 1.0 : -1.0;  // a mirror in the plane x = 0
      mirrored.row(starts[Joints()[j].mirror] + i) = sign * features.row(starts[j] + i);
    }
  }
  for (const int row : {feature::kTilt + 1, feature::kVelocity, feature::kYawRate})
    mirrored.row(row) *= -1.0;
  return mirrored;
}

}  // namespace poselift
