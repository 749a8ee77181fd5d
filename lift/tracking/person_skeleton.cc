// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/person_skeleton.h"

#include <fmt/format.h>

#include "lift/body_proportions.h"
#include "lift/normalize.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kShortest_m = 0.005, kLongest_m = 1.0;

}  // namespace

Skeleton PersonSkeleton(const Skeleton& standard, const BodyTags& tags) {
  Eigen::VectorXd lengths_m = BoneLengths(standard);
  for (const auto& [name, length_m] : tags.bone_lengths_m) {
    const auto joint = FindJoint(name);
    if (!joint || *joint == joint::kPelvis)
      throw InputError(
          fmt::format("found a bone that ends at '{}', wanted one that ends at a joint", name));
    if (!(length_m >= kShortest_m && length_m <= kLongest_m))
      throw InputError(fmt::format("found a bone to {} of {} m, wanted {} to {} m", name, length_m,
                                   kShortest_m, kLongest_m));
    lengths_m[*joint] = length_m;
  }
  return tags.bone_lengths_m.empty() ? standard : WithBoneLengths(standard, lengths_m);
}

}  // namespace poselift
