// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/random_dictionary.h"

#include <string_view>

#include "src/forward_kinematics.h"
#include "src/units.h"

namespace poselift::testing {
namespace {

// The right side is made from the left.
struct BoneRow {
  int joint;
  Eigen::Vector3d tip_m;
  double axis_z_deg;
  std::string_view dofs;  // of "xyz"
};

const std::vector<BoneRow>& LeftAndMiddle() {
  static const std::vector<BoneRow> kRows = {
      {joint::kPelvis, {0, 0, 0}, 0, ""},
      {joint::kLeftHip, {0.1, -0.09, 0.05}, 0, ""},
      {joint::kLeftKnee, {0.13, -0.37, 0}, 20, "xyz"},
      {joint::kLeftAnkle, {0.14, -0.38, 0}, 20, "x"},
      {joint::kLeftFoot, {0.02, -0.05, 0.12}, 0, "xz"},
      {joint::kLowerBack, {0, 0.11, -0.01}, 0, "xyz"},
      {joint::kUpperBack, {0, 0.12, 0}, 0, "xyz"},
      {joint::kThorax, {0, 0.12, 0.01}, 0, "xyz"},
      {joint::kLowerNeck, {0, 0.09, 0.01}, 0, "xyz"},
      {joint::kUpperNeck, {0, 0.08, -0.01}, 0, "xyz"},
      {joint::kHeadTop, {0, 0.09, 0.01}, 0, "xyz"},
      {joint::kLeftShoulder, {0.17, 0.04, -0.02}, 0, ""},
      {joint::kLeftElbow, {0.28, 0, 0}, -30, "xyz"},
      {joint::kLeftWrist, {0.25, 0, 0}, -30, "x"},
      {joint::kLeftHand, {0.09, 0, 0}, -90, "y"},
  };
  return kRows;
}

Bone LeftBone(const BoneRow& row) {
  Bone bone;
  bone.name = Joints()[row.joint].cmu_bone;
  bone.parent = Joints()[row.joint].parent;
  bone.tip_m = row.tip_m;
  bone.rest_from_axis =
      Eigen::AngleAxisd(row.axis_z_deg * kRadFromDeg, Eigen::Vector3d::UnitZ()).matrix();
  for (const char axis : row.dofs)
    bone.dofs.push_back(
        {static_cast<Dof::Kind>(axis - 'x'), -40.0 * kRadFromDeg, 130.0 * kRadFromDeg});
  return bone;
}

// In x: rotations about y and z turn the other way.
Bone Mirrored(const Bone& left, int joint) {
  const Eigen::DiagonalMatrix<double, 3> mirror(-1, 1, 1);
  Bone right = left;
  right.name = Joints()[joint].cmu_bone;
  right.parent = Joints()[joint].parent;
  right.tip_m = mirror * left.tip_m;
  right.rest_from_axis = mirror * left.rest_from_axis * mirror;
  for (Dof& dof : right.dofs)
    if (dof.Axis() != 0) dof = {dof.kind, -dof.upper, -dof.lower};
  return right;
}

}  // namespace

Skeleton SmallSkeleton() {
  Skeleton skeleton;
  skeleton.name = "small";
  skeleton.bones.resize(kNumJoints);
  for (const BoneRow& row : LeftAndMiddle()) {
    const int other = Joints()[row.joint].mirror;
    skeleton.bones[row.joint] = LeftBone(row);
    if (other != row.joint) skeleton.bones[other] = Mirrored(LeftBone(row), other);
  }
  for (Bone& bone : skeleton.bones)
    if (bone.parent >= 0) bone.offset_m = skeleton.bones[bone.parent].tip_m;
  return skeleton;
}

Dictionary RandomDictionary(int num_atoms, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  Dictionary dictionary;
  dictionary.atoms = Eigen::MatrixXd::NullaryExpr(3 * kNumJoints, num_atoms,
                                                  [&](Eigen::Index) { return normal(*rng); });
  dictionary.atoms.middleRows<3>(3 * joint::kPelvis).setZero();
  dictionary.atoms.colwise().normalize();
  dictionary.skeleton = SmallSkeleton();
  dictionary.typical_norm_m =
      JointPositions(dictionary.skeleton, SkeletonPose::Rest(dictionary.skeleton)).norm();
  return dictionary;
}

}  // namespace poselift::testing
