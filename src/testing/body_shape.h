// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "src/skeleton.h"
#include "src/testing/round_cone.h"

namespace poselift::testing {

// A part of a body around a bone, in the bone's frame.
struct BodyPart {
  int bone = 0;
  RoundCone cone;
  Eigen::Vector3f albedo_bgr;  // 0 black, 1 white
};

// A plainly dressed person around the bones of a CMU skeleton (x the subject's left,
// y up, z forward at rest), as thick as its legs are long. Bones with other names stay
// bare. Throws InputError when all do.
std::vector<BodyPart> BodyAround(const Skeleton& skeleton);

}  // namespace poselift::testing
