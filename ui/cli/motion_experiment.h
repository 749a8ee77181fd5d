// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lift/eval/evaluate_motion.h"
#include "lift/temporal/motion_database.h"

namespace poselift::cli {

// The actions of the motion paper's figure 3, and the trials that stand for them.
struct Action {
  std::string name;
  std::vector<std::string> trials;    // whose figures are reported
  std::vector<std::string> held_out;  // on which settings are chosen
  std::vector<std::string> similar;   // others of the action; there may be none
};
const std::vector<Action>& PaperActions();

struct MotionExperimentOptions {
  std::string mocap;
  std::string asf;
  double fps = 60.0;
  bool held_out = false;  // neither kind of trials is in the database then
  uint64_t seed = 1;      // of the small database
};

// What the methods share.
struct MotionExperiment {
  std::vector<std::string> actions;
  std::vector<MotionTrial> trials;
  MotionDatabase database;  // all other trials
  MotionDatabase small;     // of these as large a part as in the paper's table 2
};

// Throws InputError as LoadMotionDatabase does, and when a trial is not there.
MotionExperiment LoadMotionExperiment(const MotionExperimentOptions& options);

}  // namespace poselift::cli
