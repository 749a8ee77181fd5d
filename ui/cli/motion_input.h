// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>
#include <string>

#include "lift/poses_to_motion.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the name of CLI11
class App;
}

namespace poselift::cli {

// What the commands that take a motion need to read it: a motion file, told by
// its ending, or lifted poses (.json), whose frames may be unknown.
struct MotionInputOptions {
  std::string skeleton;
  std::string dictionary;
  std::string units = "cm";
  double fps = 0.0;  // 0: as the file says
  std::optional<int> person_id;
  bool with_filled = false;  // no option: PosesToMotionOptions
};

void AddMotionInputOptions(CLI::App* command, MotionInputOptions* options);

bool IsPosesFile(const std::string& path);  // by the ending

// A motion file comes as poses of a camera at the origin of its world, so that
// it can be written as poses. Progress shows on stderr.
PosesMotion ReadMotionInput(const std::string& path, const MotionInputOptions& options);

}  // namespace poselift::cli
