// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/methods.h"

#include <stdexcept>

namespace poselift::cli {

std::vector<std::string> MethodNames() { return {"poselift", "paper", "paper-one-start"}; }

LiftPhotoOptions FindMethod(const std::string& name) {
  LiftPhotoOptions options;
  if (name == "poselift") return options;
  // (P1) as the paper has it: no prior on the pose, and few atoms in its stead.
  options.lifter.prior_weight = 0.0;
  options.refinement.prior_weight = 0.0;
  options.lifter.omp.max_atoms = 5;
  if (name == "paper") return options;
  // From the front.
  options.lifter.views = {.num_yaws = 1, .pitches_rad = {0.0}, .num_starts = 1};
  if (name == "paper-one-start") return options;
  throw std::invalid_argument("no method " + name);
}

}  // namespace poselift::cli
