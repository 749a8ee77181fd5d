// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "lift/train/train_codebook.h"
#include "lift/train/training_poses.h"

namespace poselift::cli {

// `train --motion`.
struct MotionTrainOptions {
  std::string mocap;
  std::string out;
  std::string json;
  MotionChoice choice;
  std::vector<std::string> held_out;  // subjects or trials to test with
  CodebookOptions codebook;
};

// Learns a motion codebook on the default dictionary's skeleton. Returns the exit code.
int TrainMotion(const MotionTrainOptions& options);

// The folder's or file's own name, without the path of this machine.
std::string NameOf(const std::string& path);

}  // namespace poselift::cli
