// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/dictionary_check.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

namespace poselift {
namespace {

constexpr Eigen::Index kRows = 3 * kNumJoints;
constexpr double kLargestLength_m = 10.0;
constexpr double kLargestTypicalNorm_m = 100.0;
constexpr double kLargestLimit = 1e3;       // radians or metres
constexpr double kLargestWhitening = 1e12;  // 1/m
constexpr double kTolerance = 1e-6;         // of unit norms and of rotations
constexpr size_t kMostDofs = 6;

// False for NaN.
template <typename Derived>
bool AllWithin(const Eigen::MatrixBase<Derived>& matrix, double largest) {
  return (matrix.array().abs() <= largest).all();
}

bool IsRotation(const Eigen::Matrix3d& matrix) {
  return AllWithin(matrix * matrix.transpose() - Eigen::Matrix3d::Identity(), kTolerance) &&
         matrix.determinant() > 0.0;
}

// A limit may be absent, on its own side.
bool AreLimits(const Dof& dof) {
  const bool lower_ok = std::abs(dof.lower) <= kLargestLimit || dof.lower == -HUGE_VAL;
  const bool upper_ok = std::abs(dof.upper) <= kLargestLimit || dof.upper == HUGE_VAL;
  return lower_ok && upper_ok && dof.lower <= dof.upper;
}

std::string AtomFlaw(const Eigen::MatrixXd& atoms) {
  if (atoms.rows() != kRows || atoms.cols() < 1)
    return fmt::format("the atoms are {} x {}, wanted {} rows and at least one column",
                       atoms.rows(), atoms.cols(), kRows);
  for (Eigen::Index k = 0; k < atoms.cols(); ++k)
    if (const double norm = atoms.col(k).norm(); !(std::abs(norm - 1.0) <= kTolerance))
      return fmt::format("atom {} has norm {:g}, wanted 1", k, norm);
  return "";
}

std::string DofFlaw(const Bone& bone, size_t most_dofs) {
  if (bone.dofs.size() > most_dofs)
    return fmt::format("bone {} has {} degrees of freedom, wanted at most {}", bone.name,
                       bone.dofs.size(), most_dofs);
  for (const Dof& dof : bone.dofs)
    if (!AreLimits(dof))
      return fmt::format(
          "bone {} has a degree of freedom from {:g} to {:g}, wanted limits in "
          "order and at most {:g}",
          bone.name, dof.lower, dof.upper, kLargestLimit);
  return "";
}

std::string BoneFlaw(int index, const Bone& bone) {
  const JointInfo& joint = Joints()[index];
  if (bone.name != joint.cmu_bone)
    return fmt::format("bone {} is not the wanted {}", index, joint.cmu_bone);
  if (bone.parent != joint.parent)
    return fmt::format("bone {} has parent {}, wanted {}", bone.name, bone.parent, joint.parent);
  if (!AllWithin(bone.offset_m, kLargestLength_m) || !AllWithin(bone.tip_m, kLargestLength_m))
    return fmt::format("bone {} has an offset or a tip beyond {:g} m", bone.name, kLargestLength_m);
  if (!IsRotation(bone.rest_from_axis))
    return fmt::format("bone {} has an axis frame that is no rotation", bone.name);
  return DofFlaw(bone, index == joint::kPelvis ? 0 : kMostDofs);
}

std::string SkeletonFlaw(const Skeleton& skeleton) {
  if (skeleton.bones.size() != kNumJoints)
    return fmt::format("the skeleton has {} bones, wanted {}", skeleton.bones.size(), kNumJoints);
  for (int b = 0; b < kNumJoints; ++b)
    if (std::string flaw = BoneFlaw(b, skeleton.bones[b]); !flaw.empty()) return flaw;
  return "";
}

std::string PriorFlaw(const PosePrior& prior) {
  if (prior.Empty() && prior.whitening.size() == 0) return "";
  if (prior.mean_m.size() != kRows || prior.whitening.rows() != kRows ||
      prior.whitening.cols() != kRows)
    return fmt::format(
        "the prior has a mean of {} numbers and a whitening of {} x {}, wanted {}, "
        "and as many squared",
        prior.mean_m.size(), prior.whitening.rows(), prior.whitening.cols(), kRows);
  if (!AllWithin(prior.mean_m, kLargestLength_m))
    return fmt::format("the prior's mean has a number beyond {:g} m", kLargestLength_m);
  if (!AllWithin(prior.whitening, kLargestWhitening))
    return fmt::format("the prior's whitening has a number beyond {:g} per metre",
                       kLargestWhitening);
  return "";
}

std::string RecordFlaw(const TrainingRecord& record) {
  if (record.num_poses < 0 || record.sparsity < 0 || record.num_subsets < 0)
    return fmt::format(
        "the training record says {} poses, sparsity {}, {} subsets; wanted none "
        "of them negative",
        record.num_poses, record.sparsity, record.num_subsets);
  if (!std::isfinite(record.rms_error_mm) || record.rms_error_mm < 0.0)
    return fmt::format("the training record says an error of {:g} mm, wanted 0 or more",
                       record.rms_error_mm);
  return "";
}

}  // namespace

std::string DictionaryFlaw(const Dictionary& dictionary) {
  for (const std::string& flaw : {AtomFlaw(dictionary.atoms), SkeletonFlaw(dictionary.skeleton),
                                  PriorFlaw(dictionary.prior), RecordFlaw(dictionary.record)})
    if (!flaw.empty()) return flaw;
  const double norm_m = dictionary.typical_norm_m;
  if (!(norm_m > 0.0 && norm_m <= kLargestTypicalNorm_m))
    return fmt::format("the typical norm is {:g} m, wanted more than 0 and at most {:g}", norm_m,
                       kLargestTypicalNorm_m);
  return "";
}

}  // namespace poselift
