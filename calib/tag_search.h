// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "calib/tag_detector.h"

namespace poselift {

struct TagSearchOptions {
  TagDetectorOptions detector;
  int threads = 1;  // that share regions, and whole frames in strips
  // Whole frames: every so many frames at half the resolution, and at the full one.
  double glance_decimate = 2.0;
  int glance_every = 3, full_every = 30;  // 1: always
  // A region reaches around predicted corners by this part of the tag's longest side, and by
  // min_margin_px at least.
  double margin = 0.5;
  double min_margin_px = 24.0;
  // A tag that was seen and is not found in its region brings a glance at once; after so
  // many frames in a row without it, it is given up and waits for the next whole frame.
  int patience = 3;

  std::string Validate() const;
};

// Finds tags in a video: near where they are predicted, in regions at full resolution, and in
// whole frames every so often. No tag that whole frames would show is lost for longer than
// full_every frames, none that a glance shows for longer than glance_every, and none that was
// followed without a glance.
class TagSearch {
 public:
  using Corners = Eigen::Matrix<double, 2, 4>;

  explicit TagSearch(const TagFamily& family, const TagSearchOptions& options = {});

  // predicted_px: corners of tags by id, from a motion model; what is not in it is looked for
  // where it was last, moved on by what it moved before. Detections as those of TagDetector.
  std::vector<TagDetection> Detect(const cv::Mat& grey,
                                   const std::map<int, Corners>& predicted_px = {});

  enum class Look { kRegions, kGlance, kFull };
  Look last_look() const { return last_look_; }

 private:
  struct Seen {
    Corners corners_px, moved_px;
    int frames_ago = 0;
  };

  std::vector<cv::Rect> Regions(const cv::Size& size,
                                const std::map<int, Corners>& predicted_px) const;
  bool IsOneMissing(const std::vector<TagDetection>& found) const;
  std::vector<TagDetection> DetectInStrips(const cv::Mat& grey,
                                           std::vector<TagDetector>* detectors);
  void Remember(const std::vector<TagDetection>& found);

  TagSearchOptions options_;
  std::vector<TagDetector> at_full_, at_glance_;  // resolutions, one a thread
  TagDetector coarse_;                            // for tags too large for a strip
  std::map<int, Seen> seen_;
  int to_full_ = 0, to_glance_ = 0;  // frames
  Look last_look_ = Look::kFull;
};

}  // namespace poselift
