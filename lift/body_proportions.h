// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "src/poses.h"
#include "src/skeleton.h"

namespace poselift {

// The proportions of a body, the same left and right: the bones of a group are by
// one factor longer or shorter than on the standard skeleton,
//
//   length = exp(log_ratio of the group) * length on the standard skeleton.
//
// A picture does not tell how large a body is, so these are meant at equal stature:
// the sum of shank, thigh, trunk, neck and head is the standard skeleton's.
//
// The skeletons here are those of TrimToJoints: their bone j ends at joint j, and
// begins where its parent ends.
inline constexpr int kNumBoneGroups = 9;
using GroupVector = Eigen::Matrix<double, kNumBoneGroups, 1>;
using GroupMatrix = Eigen::Matrix<double, kNumBoneGroups, kNumBoneGroups>;

// "hip" (from the pelvis), "thigh", "shank", "foot", "trunk", "head" (with the
// neck), "shoulder" (from the thorax), "upper_arm", "forearm" (to the joint "hand").
const std::array<std::string_view, kNumBoneGroups>& BoneGroupNames();

// The group of the bone that ends at a joint; -1 for the pelvis.
int GroupOfJoint(int joint);

// A Gaussian of log ratios. Without a covariance they are known.
struct BodyProportions {
  GroupVector log_ratios = GroupVector::Zero();
  GroupMatrix covariance = GroupMatrix::Zero();
};

// Of people about the standard skeleton, which is their mean. Their size is open by
// a tenth: that much the scale may be off at which frames were lifted.
BodyProportions ProportionPrior();

// Sets the lengths of `body`, which has the bones of `standard`.
void SetProportions(const Skeleton& standard, const GroupVector& log_ratios, Skeleton* body);
Skeleton WithProportions(const Skeleton& standard, const GroupVector& log_ratios);

// The skeleton with bones of these lengths, 23 by the joints at their ends.
Skeleton WithBoneLengths(const Skeleton& skeleton, const Eigen::VectorXd& lengths_m);

// From lengths of the bones that end at each joint (normalize.h), 23: the ratios of
// the groups' sums, left and right together.
GroupVector LogRatios(const Eigen::VectorXd& lengths_m, const Eigen::VectorXd& standard_lengths_m);

// The logarithm of how much taller than the standard skeleton these ratios are, and
// the proportions without it.
double LogStature(const GroupVector& log_ratios, const Eigen::VectorXd& standard_lengths_m);
BodyProportions AtEqualStature(const BodyProportions& body,
                               const Eigen::VectorXd& standard_lengths_m);

// From the soles to the crown of the skeleton when it stands upright: ankle, legs, the
// hips below the pelvis, trunk, neck and head, each at full length.
double Stature_m(const Skeleton& skeleton);

// Lengths of the bones and their standard deviations.
PersonBones BonesOf(const BodyProportions& body, const Eigen::VectorXd& standard_lengths_m);

}  // namespace poselift
