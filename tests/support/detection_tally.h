// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "src/tag_detection.h"
#include "src/testing/body_renderer.h"

namespace poselift::testing {

// How many of the tags of rendered frames a detector finds, and how well.
struct DetectionTally {
  int visible = 0;          // whole, turned away by less than 60 degrees
  int found = 0;            // of those
  int wrong = 0;            // no such id there: none of its corners within 3 px
  int corners = 0;          // of those that were found
  double square_px2 = 0.0;  // sum over corners

  void Add(const FrameTruth& truth, const std::vector<TagDetection>& detections);

  double Share() const;  // found of visible
  double CornerRms_px() const;
};

}  // namespace poselift::testing
