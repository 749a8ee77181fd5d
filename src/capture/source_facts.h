// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <limits>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/capture/camera_controls.h"
#include "src/capture/camera_stream.h"
#include "src/capture/live_frame_source.h"
#include "src/io/frame_source.h"

namespace poselift {

// A camera as its driver describes it, and what it gave.
struct CameraFacts {
  std::vector<CameraFormat> formats;
  std::vector<CameraControl> controls;
  CameraMode wanted, asked, given;
  CaptureCounts counts;
};

// What tags in the pictures tell.
struct TagFacts {
  int num_found = 0;           // in pictures as they are
  int num_found_mirrored = 0;  // in the same pictures, mirrored
  // Of their edges, from 10 to 90 % of the way from black to white, along the tag's axis
  // with the sharper edges and along the other: across the motion, if any. Medians;
  // NaN where none could be measured.
  double sharper_edge_px = std::numeric_limits<double>::quiet_NaN();
  double wider_edge_px = std::numeric_limits<double>::quiet_NaN();
};

// What was seen of a source of frames in some seconds.
struct SourceFacts {
  std::string name;
  std::optional<CameraFacts> camera;  // nothing of files
  int num_frames = 0;
  double duration_s = 0.0;  // from the first to the last
  double longest_gap_s = 0.0;
  // Grey levels of all pixels, 0 to 255.
  double mean_grey = 0.0;
  double dark_part = 0.0;        // below 30
  double saturated_part = 0.0;   // above 250
  std::vector<cv::Mat> samples;  // some of the pictures, grey, evenly over the time
  std::optional<TagFacts> tags;

  // 0 where there are less than two frames.
  double rate_hz() const { return duration_s > 0.0 ? (num_frames - 1) / duration_s : 0.0; }
};

// Reads the source, which gives grey, to its end or for so long by its own times.
SourceFacts WatchSource(FrameSource* source, double seconds);

// What a camera is and gave so far.
CameraFacts FactsOf(const LiveFrameSource& source, const CameraMode& wanted);

}  // namespace poselift
