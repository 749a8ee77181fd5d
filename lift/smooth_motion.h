// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "lift/baselines/interpolation.h"
#include "lift/frame_span.h"
#include "src/motion.h"

namespace poselift {

// A way to smooth a motion. Unknown frames (motion.h) in gaps of at most
// max_gap_frames come back filled, those of longer gaps unknown. The number of
// frames, the frame time and the skeleton stay.
using MotionSmoother = std::function<Motion(const Motion& motion, int max_gap_frames)>;

// One that works on curves: fills the gaps of MotionCurves, then hands them to
// the filter, which treats what lies between two long gaps on its own.
using CurveFilter =
    std::function<Eigen::MatrixXd(const Eigen::MatrixXd& curves, double frame_rate_hz)>;
MotionSmoother SmootherOfCurves(GapFill fill, CurveFilter filter);

struct SmoothMotionOptions {
  // Longer gaps are not filled by the smoother: 0.5 s is half a stride, of
  // which nobody knows what the body did.
  double max_gap_s = 0.5;

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct SmoothedMotion {
  Motion motion;  // every frame is there
  std::vector<FrameSpan> filled;
  // Frames of gaps that were too long, and at the ends: a straight line, or the
  // nearest pose held. Something to write in a file, not something known.
  std::vector<FrameSpan> unknown;
  // Mean length of the second difference of the bones' tips, mm / frame^2, where
  // three frames in a row were known before; -1 where there are none.
  double jitter_before_mm = -1.0;
  double jitter_after_mm = -1.0;
  double moved_mm = -1.0;  // mean distance of the tips from where they were
};

// Throws InputError when the options are invalid or no frame is known, and what
// the smoother throws.
SmoothedMotion SmoothMotion(const Motion& motion, const MotionSmoother& smoother,
                            const SmoothMotionOptions& options = {});

// The tips of the bones of every frame, 3 B x T, metres in world; NaN where the
// frame is unknown.
Eigen::MatrixXd BoneTips(const Motion& motion);

// As in SmoothedMotion: of these frames alone, and their neighbours.
double Jitter_mm(const Eigen::MatrixXd& tips_in_world_m, const std::vector<bool>& frames);

}  // namespace poselift
