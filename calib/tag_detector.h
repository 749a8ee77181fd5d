// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "calib/tag_family.h"
#include "src/tag_detection.h"

namespace poselift {

struct TagDetectorOptions {
  // Squares are searched in the picture made smaller by this: 1, 1.5, 2, 3, ... Bits and
  // corners are read at full resolution, but tags below 30 px or so are lost at 2.
  double decimate = 1.0;
  // Blur before squares are searched, px of the decimated picture: 0.8 for a noisy one.
  double blur_sigma_px = 0.0;
  int max_hamming = 1;  // bits set right: 0 or 1; more invents tags where there are none
  double min_decision_margin = 20.0;  // grey levels; false tags have less
  std::vector<int> known_ids;         // empty: all of the family
  bool refine_corners = true;         // false: as libapriltag has them, some 0.06 px off

  std::string Validate() const;
};

// Finds the tags of one family in grey pictures: libapriltag (Wang and Olson 2016), its
// corners then moved to where the edges are (tag_corners.h): off by 0.01 px at 2 grey levels
// of noise, without bias.
//
// Own one for each thread that detects: Detect changes it. libapriltag's own threads are not used:
// now and then they crash as they start, and they race (AprilRobotics/apriltag, issues 70 and
// 387). Memory: a table of all codes and of those one bit off; some
// 120 MB for tagStandard52h13 and a few MB for tag36h11, or next to nothing with known_ids.
class TagDetector {
 public:
  // Throws InputError for options that are not valid and ids that the family does not have.
  explicit TagDetector(const TagFamily& family, const TagDetectorOptions& options = {});
  ~TagDetector();
  TagDetector(TagDetector&& other) noexcept;
  TagDetector& operator=(TagDetector&& other) noexcept;

  // By rising id, each once. grey: 8-bit, one channel, is not changed; a picture too small for
  // a tag has none.
  std::vector<TagDetection> Detect(const cv::Mat& grey);

  // Ids that the last picture showed more than once: the one with fewer corrected bits, then
  // with the larger decision margin, was kept. A mirror, a screen or two prints of one id.
  const std::vector<int>& duplicated_ids() const;

  const TagDetectorOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poselift
