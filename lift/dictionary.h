// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift/pose_prior.h"
#include "src/skeleton.h"

namespace poselift {

// How a dictionary came to be; a part of its file.
struct TrainingRecord {
  std::vector<std::string> sources;  // the motion files' names
  std::string command;
  std::string commit;
  long num_poses = 0;
  bool mirrored = false;  // every pose was used left-right mirrored too
  int sparsity = 0;       // kappa of the training
  int num_subsets = 0;
  unsigned long seed = 0;
  double rms_error_mm = 0.0;  // of the training set's joints, coded with `sparsity` atoms
};

// A of the sparse coding paper: poses in the body frame (pelvis at the origin,
// root orientation zero) of one standard skeleton are sums of a few atoms.
struct Dictionary {
  Eigen::MatrixXd atoms;  // 69 x K, columns of unit norm
  Skeleton skeleton;      // the standard skeleton: 23 bones, 46 degrees of freedom
  // |y| of a typical training pose, metres: an atom times this is about life-size.
  double typical_norm_m = 1.0;
  PosePrior prior;  // of the training poses
  TrainingRecord record;

  int NumAtoms() const { return static_cast<int>(atoms.cols()); }
};

}  // namespace poselift
