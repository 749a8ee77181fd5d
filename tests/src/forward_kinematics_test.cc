// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up skeleton with rotated axes, mixed dof subsets and shifts; the
// analytic Jacobian against central differences.
#include "src/forward_kinematics.h"

#include <gtest/gtest.h>

#include "src/units.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::TestRng;

// The CMU tree with random bones, axes and dofs.
Skeleton RandomSkeleton(std::mt19937_64* rng) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random_vector = [&] {
    return Eigen::Vector3d(uniform(*rng), uniform(*rng), uniform(*rng));
  };
  Skeleton skeleton;
  for (int j = 0; j < kNumJoints; ++j) {
    Bone bone;
    bone.name = Joints()[j].cmu_bone;
    bone.parent = Joints()[j].parent;
    bone.tip_m = 0.3 * random_vector();
    if (j > 0) {
      bone.offset_m = skeleton.bones[bone.parent].tip_m;
      bone.rest_from_axis =
          Eigen::AngleAxisd(3.0 * uniform(*rng), random_vector().normalized()).matrix();
      for (int k = 0; k <= 5; ++k)
        if (uniform(*rng) > 0.2) bone.dofs.push_back({static_cast<Dof::Kind>(k)});
    }
    skeleton.bones.push_back(bone);
  }
  return skeleton;
}

SkeletonPose RandomPose(const Skeleton& skeleton, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  SkeletonPose pose = SkeletonPose::Rest(skeleton);
  for (double& value : pose.dofs) value = normal(*rng);
  pose.root_in_world_m << normal(*rng), normal(*rng), normal(*rng);
  pose.world_from_root =
      Eigen::Quaterniond(normal(*rng), normal(*rng), normal(*rng), normal(*rng)).normalized();
  return pose;
}

SkeletonPose Moved(const SkeletonPose& pose, int column, double step) {
  SkeletonPose moved = pose;
  if (column < 3) {
    moved.root_in_world_m[column] += step;
  } else if (column < 6) {
    moved.world_from_root =
        Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(column - 3)) * pose.world_from_root;
  } else {
    moved.dofs[column - 6] += step;
  }
  return moved;
}

TEST(ForwardKinematics, BendsTheElbowOfAnArmByHand) {
  Skeleton arm;
  arm.bones = {{.name = "root"},
               {.name = "upper", .parent = 0, .tip_m = {1, 0, 0}},
               {.name = "lower",
                .parent = 1,
                .offset_m = {1, 0, 0},
                .tip_m = {0.5, 0, 0},
                .dofs = {{Dof::Kind::kRz}}}};
  SkeletonPose pose = SkeletonPose::Rest(arm);
  pose.dofs << 90 * kRadFromDeg;
  BoneFrames frames;
  ForwardKinematics(arm, pose, &frames);
  EXPECT_TRUE(MatrixNear(frames.tip_in_world_m.col(2), Eigen::Vector3d(1, 0.5, 0), 1e-15));
}

TEST(ForwardKinematics, JacobianEqualsCentralDifferences) {
  auto rng = TestRng();
  for (int trial = 0; trial < 5; ++trial) {
    const Skeleton skeleton = RandomSkeleton(&rng);
    const SkeletonPose pose = RandomPose(skeleton, &rng);
    const JointSites sites = FindJointSites(skeleton);
    BoneFrames frames;
    ForwardKinematics(skeleton, pose, &frames);
    Eigen::MatrixXd jacobian;
    JointJacobian(skeleton, sites, pose, frames, &jacobian);
    Eigen::MatrixXd numeric(jacobian.rows(), jacobian.cols());
    const double h = 1e-6;
    for (int c = 0; c < numeric.cols(); ++c) {
      const Pose3 ahead = JointPositions(skeleton, Moved(pose, c, h));
      const Pose3 behind = JointPositions(skeleton, Moved(pose, c, -h));
      numeric.col(c) = (Stacked(ahead) - Stacked(behind)) / (2 * h);
    }
    EXPECT_TRUE(MatrixNear(jacobian, numeric, 1e-8));
  }
}

TEST(ForwardKinematics, FrameJacobianEqualsCentralDifferences) {
  auto rng = TestRng();
  const Eigen::Vector3d x_in_bone_m(0.1, -0.3, 0.2);
  for (int trial = 0; trial < 5; ++trial) {
    const Skeleton skeleton = RandomSkeleton(&rng);
    const SkeletonPose pose = RandomPose(skeleton, &rng);
    const int bone = static_cast<int>(skeleton.bones.size()) - 1 - trial;
    const auto place = [&](const SkeletonPose& at, Eigen::Matrix3d* rotation) -> Eigen::Vector3d {
      BoneFrames frames;
      ForwardKinematics(skeleton, at, &frames);
      *rotation = frames.world_from_bone[bone];
      return frames.start_in_world_m.col(bone) + *rotation * x_in_bone_m;
    };
    BoneFrames frames;
    ForwardKinematics(skeleton, pose, &frames);
    Eigen::Matrix3d R, ahead, behind;
    Eigen::MatrixXd jacobian;
    FrameJacobian(skeleton, bone, place(pose, &R), pose, frames, &jacobian);
    Eigen::MatrixXd numeric(6, jacobian.cols());
    const double h = 1e-6;
    for (int c = 0; c < numeric.cols(); ++c) {
      const Eigen::Vector3d moved_m =
          place(Moved(pose, c, h), &ahead) - place(Moved(pose, c, -h), &behind);
      const Eigen::Matrix3d turned = (ahead - behind) * R.transpose();
      numeric.col(c) << moved_m / (2 * h),
          Eigen::Vector3d(turned(2, 1), turned(0, 2), turned(1, 0)) / (2 * h);
    }
    EXPECT_TRUE(MatrixNear(jacobian, numeric, 1e-8));
  }
}

}  // namespace
}  // namespace poselift
