// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/body_proportions.h"

#include <cmath>

#include "lift/normalize.h"
#include "src/forward_kinematics.h"
#include "src/joints.h"

namespace poselift {
namespace {

enum Group { kHip, kThigh, kShank, kFoot, kTrunk, kHead, kShoulder, kUpperArm, kForearm };

// Sample covariance of the training subjects of docs/RESULTS.md about their mean
// skeleton, shrunk half way to a multiple of the identity (Ledoit and Wolf 2004): they
// are seven. Percent squared, the lower triangle.
constexpr double kCovariance_percent2[] = {
    16.7, 0.3,  29.3, 0.4,  -7.6, 19.0, -0.8, 4.4,  0.3,   35.5, 0.7,  -1.2, 0.3,  -4.6,  16.2,
    -2.1, -7.8, 3.4,  -1.1, -0.8, 21.5, 0.2,  6.0,  -2.7,  2.8,  -0.7, -3.6, 18.9, 0.6,   -3.8,
    2.1,  -3.1, 2.0,  -0.3, -2.5, 20.1, -5.7, 22.1, -14.3, -2.0, -3.6, -4.3, 11.0, -12.9, 83.3,
};
constexpr double kSizeSigma = 0.1;

// Lengths of the groups, both sides together.
GroupVector GroupSums(const Eigen::VectorXd& lengths_m) {
  GroupVector sums_m = GroupVector::Zero();
  for (int j = 1; j < kNumJoints; ++j) sums_m[GroupOfJoint(j)] += lengths_m[j];
  return sums_m;
}

// The part that each group has of the stature; there are two legs.
GroupVector StatureShares(const Eigen::VectorXd& lengths_m) {
  const GroupVector sums_m = GroupSums(lengths_m);
  GroupVector shares = GroupVector::Zero();
  for (const Group leg : {kThigh, kShank}) shares[leg] = 0.5 * sums_m[leg];
  for (const Group axial : {kTrunk, kHead}) shares[axial] = sums_m[axial];
  return shares / shares.sum();
}

template <typename Ratio>
void ScaleBones(const Skeleton& standard, const Ratio& ratio_of_joint, Skeleton* body) {
  for (int j = 1; j < kNumJoints; ++j) {
    const Bone& bone = standard.bones[static_cast<size_t>(j)];
    Bone& own = body->bones[static_cast<size_t>(j)];
    own.tip_m = ratio_of_joint(j) * bone.tip_m;
    if (bone.parent > 0) own.offset_m = ratio_of_joint(bone.parent) * bone.offset_m;
  }
}

}  // namespace

const std::array<std::string_view, kNumBoneGroups>& BoneGroupNames() {
  static constexpr std::array<std::string_view, kNumBoneGroups> kNames = {
      "hip", "thigh", "shank", "foot", "trunk", "head", "shoulder", "upper_arm", "forearm"};
  return kNames;
}

int GroupOfJoint(int joint) {
  static constexpr std::array<int, kNumJoints> kGroups = {
      -1,        kHip,     kThigh,   kShank,    kFoot,     kHip,     kThigh,  kShank,
      kFoot,     kTrunk,   kTrunk,   kTrunk,    kHead,     kHead,    kHead,   kShoulder,
      kUpperArm, kForearm, kForearm, kShoulder, kUpperArm, kForearm, kForearm};
  return kGroups[static_cast<size_t>(joint)];
}

BodyProportions ProportionPrior() {
  BodyProportions prior;
  prior.covariance.setConstant(kSizeSigma * kSizeSigma);
  for (int i = 0, k = 0; i < kNumBoneGroups; ++i)
    for (int j = 0; j <= i; ++j, ++k) {
      prior.covariance(i, j) += 1e-4 * kCovariance_percent2[k];
      prior.covariance(j, i) = prior.covariance(i, j);
    }
  return prior;
}

void SetProportions(const Skeleton& standard, const GroupVector& log_ratios, Skeleton* body) {
  const GroupVector ratios = log_ratios.array().exp();
  ScaleBones(
      standard, [&](int joint) { return ratios[GroupOfJoint(joint)]; }, body);
}

Skeleton WithProportions(const Skeleton& standard, const GroupVector& log_ratios) {
  Skeleton body = standard;
  SetProportions(standard, log_ratios, &body);
  return body;
}

Skeleton WithBoneLengths(const Skeleton& skeleton, const Eigen::VectorXd& lengths_m) {
  const Eigen::VectorXd now_m = BoneLengths(skeleton);
  Skeleton body = skeleton;
  ScaleBones(
      skeleton, [&](int joint) { return lengths_m[joint] / now_m[joint]; }, &body);
  return body;
}

GroupVector LogRatios(const Eigen::VectorXd& lengths_m, const Eigen::VectorXd& standard_lengths_m) {
  return (GroupSums(lengths_m).array() / GroupSums(standard_lengths_m).array()).log();
}

double LogStature(const GroupVector& log_ratios, const Eigen::VectorXd& standard_lengths_m) {
  return std::log(StatureShares(standard_lengths_m).dot(log_ratios.array().exp().matrix()));
}

BodyProportions AtEqualStature(const BodyProportions& body,
                               const Eigen::VectorXd& standard_lengths_m) {
  // d LogStature / d log_ratios
  const double log_stature = LogStature(body.log_ratios, standard_lengths_m);
  const GroupVector by_ratios =
      StatureShares(standard_lengths_m).array() * (body.log_ratios.array() - log_stature).exp();
  const GroupMatrix without = GroupMatrix::Identity() - GroupVector::Ones() * by_ratios.transpose();
  return {body.log_ratios.array() - log_stature, without * body.covariance * without.transpose()};
}

double Stature_m(const Skeleton& skeleton) {
  constexpr double kAnkleHeight_m = 0.08;
  const Pose3 rest_m = JointPositions(skeleton, SkeletonPose::Rest(skeleton));
  const GroupVector sums_m = GroupSums(BoneLengths(skeleton));
  return kAnkleHeight_m + 0.5 * (sums_m[kThigh] + sums_m[kShank]) + rest_m(1, joint::kPelvis) -
         rest_m(1, joint::kLeftHip) + sums_m[kTrunk] + sums_m[kHead];
}

PersonBones BonesOf(const BodyProportions& body, const Eigen::VectorXd& standard_lengths_m) {
  PersonBones bones{0, standard_lengths_m, Eigen::VectorXd::Zero(kNumJoints)};
  for (int j = 1; j < kNumJoints; ++j) {
    const int g = GroupOfJoint(j);
    bones.lengths_m[j] *= std::exp(body.log_ratios[g]);
    bones.sigmas_m[j] = bones.lengths_m[j] * std::sqrt(body.covariance(g, g));
  }
  return bones;
}

}  // namespace poselift
