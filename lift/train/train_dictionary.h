// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "lift/dictionary.h"
#include "lift/train/ksvd.h"
#include "lift/train/training_poses.h"
#include "src/progress.h"

namespace poselift {

// Learns the atoms of a dictionary from poses (69 x m, body frame, metres):
//  1. k-means splits the poses into subsets (section 5 of the paper);
//  2. each subset gets a number of atoms: by the size rule of section 4.1, or
//     its share of a given total;
//  3. K-SVD on each subset, from poses drawn at random;
//  4. the atoms of all subsets stand side by side.
struct TrainOptions {
  int num_atoms = 0;  // in all; 0: by the size rule
  // The size rule: n starts at first_atoms poses drawn from the subset and grows
  // by 1.5 until they code it with at most delta times the target error.
  double target_error_m = 0.03;  // e_t, RMS of a joint
  double delta = 2.0;
  int first_atoms = 16;  // n_0
  int num_subsets = 16;
  KsvdOptions ksvd;
  std::uint64_t seed = 1;
  int num_threads = 0;  // 0: all

  std::string Validate() const;
};

struct SubsetReport {
  long num_poses = 0;
  KsvdReport ksvd;
};

struct TrainReport {
  std::vector<SubsetReport> subsets;
  double rms_error_m = 0.0;  // of all poses, each coded over its own subset's atoms
};

// The same poses, options and seed give the same atoms, whatever the threads.
Eigen::MatrixXd TrainAtoms(const Eigen::MatrixXd& poses, const TrainOptions& options,
                           const ProgressFn& progress, TrainReport* report);

// The whole dictionary of loaded poses, with mirrored also of their left-right
// mirror images: atoms, standard skeleton, prior, and the record of the training
// but for the command and the commit, which the caller knows.
Dictionary TrainDictionary(const TrainingPoses& loaded, bool mirrored, const TrainOptions& options,
                           const ProgressFn& progress, TrainReport* report);

// The size rule alone: how many of the poses, in their order in `drawn`, must be
// atoms so that the rest is coded to delta * target.
int AtomsForTarget(const Eigen::MatrixXd& poses, const std::vector<int>& drawn,
                   const TrainOptions& options);

}  // namespace poselift
