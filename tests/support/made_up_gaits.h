// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift/temporal/motion_database.h"
#include "lift/temporal/motion_method.h"
#include "src/motion.h"

namespace poselift::testing {

// Made-up gaits of one kind: a few waves move all angles and carry the body over
// the floor, at 60 Hz.
class MadeUpGaits {
 public:
  MadeUpGaits();

  // share, 0 ... 1: which gait of the kind.
  Motion Gait(int num_frames, double share) const;
  // So many gaits, evenly spread over the kind.
  MotionDatabase Database(int num_gaits, int num_frames) const;

 private:
  Eigen::MatrixXd mixture_;
};

// Where the left hand and the right ankle are in a frame.
std::vector<TargetPoint> ObserveHandAndFoot(const Motion& motion, size_t frame);

// Fails unless what `there` makes of the motion moved over the floor and turned
// about the vertical is what `here` makes of it, moved along.
void ExpectToMoveAlong(const Motion& motion, MotionMethod* here, MotionMethod* there,
                       double tolerance = 1e-4);

}  // namespace poselift::testing
