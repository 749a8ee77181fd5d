// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "lift/dictionary.h"
#include "lift/temporal/motion_codebook.h"
#include "lift/temporal/motion_database.h"

namespace poselift::cli {

// Models for a table: learned without what they are tested on, or read from files.
struct HeldOutModels {
  std::string dictionary, motion_model;     // files; empty: learned
  std::vector<std::string> train_subjects;  // whom they are learned from
  std::vector<std::string> test_trials;     // left out of that
};

// Throw InputError as the readers and the training do.
Dictionary LearnDictionary(const std::vector<MotionSource>& sources, const HeldOutModels& options);
// With mirror images.
MotionCodebook LearnMotion(const std::vector<MotionSource>& sources, const Skeleton& standard,
                           const HeldOutModels& options);

}  // namespace poselift::cli
