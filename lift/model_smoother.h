// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <string>

#include "lift/smooth_motion.h"
#include "lift/temporal/local_pose.h"
#include "lift/temporal/motion_codebook.h"
#include "lift/temporal/segment_views.h"
#include "lift/temporal/sequence_refinement.h"

namespace poselift {

struct ModelSmootherOptions {
  int num_neighbours = 50;
  SegmentViewsOptions views{.path_weight = 1.0};
  LocalPoseOptions local;
  SequenceRefinementOptions refinement{.code_gamma_per_m2 = 0.0,
                                       .prior_weight = 0.0,
                                       .local_weight = 0.5,
                                       .rate_sigma_rad = 0.01,
                                       .covariances = false};
  // Noise is estimated (PoseNoise), and taken as no less: radians and metres.
  double least_noise = 0.002;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// Smooths a motion by a model of motion: each pose is a measurement with the
// motion's noise, similar segments of the codebook say what bodies do there
// (MakeLocalPose), and the answer is the MAP of the whole (SequenceRefinement).
// Gaps are filled by the model.
//
// A motion may be on any skeleton that is a body: rest and errors as with
// SmootherOfBody. Offline: looks at all frames. The codebook stays with the smoother.
MotionSmoother SmootherByModel(std::shared_ptr<const MotionCodebook> codebook, MotionSmoother rest,
                               const ModelSmootherOptions& options = {});

// Standard deviations of the rows of a pose's difference (MakePredictionCost) from
// third differences over the frames, which hardly know motion but grow sqrt(20)
// times the noise; by their 0.9 quantile. The root's place and turn have one each
// for all axes. Zero where there are no four known frames in a row.
FeatureVector PoseNoise(const Motion& motion);

}  // namespace poselift
