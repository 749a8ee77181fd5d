// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/ik/initial_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>

namespace poselift {
namespace {

// More dofs than a joint can have are left at rest.
constexpr int kMaxBoneDofs = 6;
constexpr double kPull = 0.01;  // of a dof to where it starts, beside unit aims
constexpr int kMaxSteps = 12;
constexpr double kLongestStep_rad = 1.0;  // beyond it the linear model says nothing
constexpr double kLastStep_rad = 1e-3;
constexpr double kGoodMisfit = 0.01;  // 6 degrees

// How much a joint says about the root's rotation before the pose is known:
// the hips are rigid with the root, the trunk nearly, the limbs hardly.
double RootWeight(int j) {
  if (j == joint::kPelvis || j == joint::kLeftHip || j == joint::kRightHip) return 1.0;
  const bool trunk = (j >= joint::kLowerBack && j <= joint::kLowerNeck) ||
                     j == joint::kLeftShoulder || j == joint::kRightShoulder;
  return trunk ? 0.1 : 1e-4;
}

// The rotation nearest to a 3 x 3 matrix (Kabsch); the determinant keeps out
// reflections.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double determinant = (svd.matrixU() * svd.matrixV()).determinant();
  const Eigen::Vector3d signs(1.0, 1.0, determinant < 0.0 ? -1.0 : 1.0);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

InitialPose::InitialPose(const Articulation& body)
    : handles_(body.skeleton.bones.size()), hinges_(body.skeleton.bones.size()) {
  AddHandles(body);
  AddHinges(body);
}

// A joint belongs to the first bone up the tree that can turn it.
void InitialPose::AddHandles(const Articulation& body) {
  const std::vector<Bone>& bones = body.skeleton.bones;
  for (int j = 0; j < kNumJoints; ++j) {
    const JointSite& site = body.sites[j];
    if (site.bone < 0) continue;
    Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
    if (site.at_tip) point_m = bones[site.bone].tip_m;
    int b = site.bone;
    while (b > 0 && (point_m.isZero() || bones[b].dofs.empty())) {
      point_m += bones[b].offset_m;
      b = bones[b].parent;
    }
    if (!point_m.isZero()) handles_[b].push_back({j, point_m});
  }
}

void InitialPose::AddHinges(const Articulation& body) {
  for (size_t b = 1; b < body.skeleton.bones.size(); ++b) {
    const Bone& bone = body.skeleton.bones[b];
    if (bone.dofs.size() != 1 || !bone.dofs[0].IsRotation()) continue;
    const Dof& dof = bone.dofs[0];
    const double sign = dof.lower + dof.upper < 0.0 ? -1.0 : 1.0;
    for (const Handle& near : handles_[bone.parent])
      for (const Handle& far : handles_[b])
        if (near.point_in_bone_m.isApprox(bone.offset_m))
          hinges_[bone.parent].push_back(
              {near.joint, far.joint, sign * bone.rest_from_axis.col(dof.Axis())});
  }
}

SkeletonPose InitialPose::AlignRoot(const Articulation& body, const Pose3& target_m,
                                    const Eigen::VectorXd& weights,
                                    const Eigen::VectorXd& dofs) const {
  SkeletonPose pose;
  pose.dofs = dofs;
  const Pose3 joints_m = JointPositions(body, pose);
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_mean_m = Eigen::Vector3d::Zero();
  double total_weight = 0.0;
  for (int j = 0; j < kNumJoints; ++j) {
    if (weights[j] <= 0.0) continue;
    total_weight += RootWeight(j);
    mean_m += RootWeight(j) * joints_m.col(j);
    target_mean_m += RootWeight(j) * target_m.col(j);
  }
  mean_m /= total_weight;
  target_mean_m /= total_weight;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int j = 0; j < kNumJoints; ++j)
    if (weights[j] > 0.0)
      covariance += RootWeight(j) * (target_m.col(j) - target_mean_m) *
                    (joints_m.col(j) - mean_m).transpose();
  const Eigen::Matrix3d rotation = NearestRotation(covariance);
  pose.world_from_root = Eigen::Quaterniond(rotation).normalized();
  pose.root_in_world_m = target_mean_m - rotation * mean_m;
  return pose;
}

std::vector<InitialPose::Aim> InitialPose::AimsOf(int bone, const Eigen::Vector3d& start_m,
                                                  const Pose3& target_m,
                                                  const Eigen::VectorXd& weights) const {
  std::vector<Aim> aims;
  for (const Handle& handle : handles_[bone]) {
    const Eigen::Vector3d to_m = target_m.col(handle.joint) - start_m;
    if (weights[handle.joint] > 0.0 && !to_m.isZero())
      aims.push_back({handle.point_in_bone_m.normalized(), to_m.normalized(), 1.0});
  }
  for (const Hinge& hinge : hinges_[bone]) {
    if (weights[hinge.near_joint] <= 0.0 || weights[hinge.far_joint] <= 0.0) continue;
    const Eigen::Vector3d near_m = target_m.col(hinge.near_joint);
    const Eigen::Vector3d far_m = target_m.col(hinge.far_joint);
    const Eigen::Vector3d normal =
        (near_m - start_m).normalized().cross((far_m - near_m).normalized());
    // The straighter the limb, the less its plane says about the twist.
    const double sine = normal.norm();
    if (sine > 0.0) aims.push_back({hinge.axis_in_bone, normal / sine, sine * sine});
  }
  return aims;
}

// Turns the aims, min sum_k weight_k |G in_bone_k - in_world_k|^2 + pull |dofs - from|^2,
// over the bone's rotations within their limits, by Gauss-Newton steps from
// *dofs; dofs at a limit that pull outwards rest. Returns what the sum, without
// the pull, is before the last step. With M = world_from_parent C,
// G = M R C^T (see Bone) and dG/d(dof_i) v = (M a_i) x (G v), where a_i is the
// dof's axis turned by the dofs after it. Shifts stay as they are.
double InitialPose::TurnFrom(const Turn& turn, const Eigen::VectorXd& from, Eigen::VectorXd* dofs) {
  const Eigen::Matrix3d& C = turn.bone.rest_from_axis;
  const Eigen::Index count = dofs->size();
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxBoneDofs> axes(3, count);
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxBoneDofs> by_dofs(3, count);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxBoneDofs, kMaxBoneDofs> hessian;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxBoneDofs, 1> step;
  double misfit = 0.0;
  for (int i = 0; i < kMaxSteps; ++i) {
    Eigen::Matrix3d rotation = turn.world_from_parent * C;
    axes.setZero();
    for (Eigen::Index k = count - 1; k >= 0; --k) {
      const Dof& dof = turn.bone.dofs[k];
      if (!dof.IsRotation()) continue;
      axes.col(k) = rotation.col(dof.Axis());
      rotation =
          rotation * Eigen::AngleAxisd((*dofs)[k], Eigen::Vector3d::Unit(dof.Axis())).matrix();
    }
    const Eigen::Matrix3d world_from_bone = rotation * C.transpose();
    hessian = kPull * Eigen::MatrixXd::Identity(count, count);
    step = kPull * (from - *dofs);
    misfit = 0.0;
    for (const Aim& aim : turn.aims) {
      const Eigen::Vector3d turned = world_from_bone * aim.in_bone;
      for (Eigen::Index k = 0; k < count; ++k)
        by_dofs.col(k) = Eigen::Vector3d(axes.col(k)).cross(turned);
      hessian += aim.weight * by_dofs.transpose() * by_dofs;
      step += aim.weight * by_dofs.transpose() * (aim.in_world - turned);
      misfit += aim.weight * (aim.in_world - turned).squaredNorm();
    }
    for (Eigen::Index k = 0; k < count; ++k) {
      const double dof = (*dofs)[k];
      if ((dof > turn.lower[k] || step[k] > 0.0) && (dof < turn.upper[k] || step[k] < 0.0))
        continue;
      hessian.row(k).setZero();
      hessian.col(k).setZero();
      hessian(k, k) = 1.0;
      step[k] = 0.0;
    }
    step = hessian.ldlt().solve(step).eval();
    const double longest_rad = step.cwiseAbs().maxCoeff();
    *dofs += step * std::min(1.0, kLongestStep_rad / longest_rad);
    *dofs = dofs->cwiseMax(turn.lower).cwiseMin(turn.upper);
    if (longest_rad < kLastStep_rad) break;
  }
  return misfit;
}

// Three angles have two sets of values for a rotation, of which the limits may
// allow one only: where the nearest does not fit, others are tried, from the
// middles of the parts of the range.
Eigen::VectorXd InitialPose::BestDofs(const Turn& turn, const Eigen::VectorXd& from) {
  Eigen::VectorXd best = from.cwiseMax(turn.lower).cwiseMin(turn.upper);
  double best_misfit = TurnFrom(turn, from, &best);
  const Eigen::Index count = from.size();
  if (count != 3 || !turn.lower.allFinite() || !turn.upper.allFinite()) return best;
  for (int corner = 0; corner < 8 && best_misfit > kGoodMisfit; ++corner) {
    Eigen::VectorXd dofs = turn.lower;
    for (int k = 0; k < 3; ++k)
      dofs[k] += (corner >> k & 1 ? 0.75 : 0.25) * (turn.upper[k] - turn.lower[k]);
    const double misfit = TurnFrom(turn, from, &dofs);
    if (misfit < best_misfit - kGoodMisfit) {
      best = dofs;
      best_misfit = misfit;
    }
  }
  return best;
}

SkeletonPose InitialPose::Find(const Articulation& body, const DofLimits& limits,
                               const Pose3& target_in_world_m, const Eigen::VectorXd& weights,
                               const Eigen::VectorXd& from_dofs) const {
  SkeletonPose pose = AlignRoot(body, target_in_world_m, weights, from_dofs);
  BoneFrames frames;
  ForwardKinematics(body.skeleton, pose, &frames);
  for (int b = 1; b < static_cast<int>(body.skeleton.bones.size()); ++b) {
    const Bone& bone = body.skeleton.bones[b];
    const int first = body.dof_starts[b];
    const int count = static_cast<int>(bone.dofs.size());
    PlaceBone(body.skeleton, b, first, pose, &frames);
    if (count == 0 || count > kMaxBoneDofs) continue;
    const Turn turn{bone, frames.world_from_bone[bone.parent],
                    AimsOf(b, frames.start_in_world_m.col(b), target_in_world_m, weights),
                    limits.lower.segment(first, count), limits.upper.segment(first, count)};
    if (turn.aims.empty()) continue;
    pose.dofs.segment(first, count) = BestDofs(turn, pose.dofs.segment(first, count));
    PlaceBone(body.skeleton, b, first, pose, &frames);
  }
  return pose;
}

}  // namespace poselift
