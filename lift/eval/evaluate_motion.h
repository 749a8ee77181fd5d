// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lift/temporal/motion_method.h"
#include "src/motion.h"
#include "src/progress.h"

namespace poselift {

// Motion reconstruction from a few control points, the experiment of the motion
// paper (tables 1, 2, figure 3): each trial's true control points, its first
// poses, and nothing else, go to every method, frame after frame.

struct MotionTrial {
  std::string action;
  std::string name;
  Motion motion;  // on the skeleton of the database, at its frame time
};

// Landmarks of body15 that are observed.
struct ControlPoints {
  std::string name;
  std::vector<std::string> landmarks;
};

// The paper's five: (1) left wrist, right ankle; (2) left wrist, both ankles;
// (3) wrists and ankles; (4) and the root; (5) and the head.
const std::vector<ControlPoints>& PaperControlPoints();

struct NamedMotionMethod {
  std::string name;
  // A fresh one for each trial: trials run in parallel.
  std::function<std::unique_ptr<MotionMethod>()> make;
};

struct MotionEvaluation {
  std::string method, action, trial, control_points;
  int num_frames = 0;
  double position_mm = 0.0;  // mean distance of the 23 joints, in world
  // Mean angle between a bone's rotations relative to its parent, root included.
  double angle_deg = 0.0;
  double acceleration_mm = 0.0;  // mean size of the error's second difference: jitter
  double ms_per_frame = 0.0;     // of processor time
};

struct EvaluateMotionOptions {
  std::vector<ControlPoints> control_points = PaperControlPoints();
  int num_first_poses = 4;  // known at the start
  double sigma_m = 0.005;   // of the control points, as the methods are told
  int max_frames = 300;     // of a trial
};

// A row for each method, trial and set of control points.
std::vector<MotionEvaluation> EvaluateMotion(const std::vector<NamedMotionMethod>& methods,
                                             const std::vector<MotionTrial>& trials,
                                             const EvaluateMotionOptions& options,
                                             const ProgressFn& progress);

}  // namespace poselift
