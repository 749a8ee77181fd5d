// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/dictionary_check.h"

#include <fmt/format.h>

#include <cmath>

#include "lift/skeleton_check.h"

namespace poselift {
namespace {

constexpr Eigen::Index kRows = 3 * kNumJoints;
constexpr double kLargestTypicalNorm_m = 100.0;
constexpr double kLargestWhitening = 1e12;  // 1/m
constexpr double kTolerance = 1e-6;         // of unit norms

std::string AtomFlaw(const Eigen::MatrixXd& atoms) {
  if (atoms.rows() != kRows || atoms.cols() < 1)
    return fmt::format("the atoms are {} x {}, wanted {} rows and at least one column",
                       atoms.rows(), atoms.cols(), kRows);
  for (Eigen::Index k = 0; k < atoms.cols(); ++k)
    if (const double norm = atoms.col(k).norm(); !(std::abs(norm - 1.0) <= kTolerance))
      return fmt::format("atom {} has norm {:g}, wanted 1", k, norm);
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
