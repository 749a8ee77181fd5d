// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/progress.h"
#include "ui/cli/lift_inputs.h"

namespace poselift::cli {

struct VideoLabelsOptions {
  std::string labels_file;  // empty: NAME.labels.json beside the video
  std::string layout = "auto";
  bool propagate = true;   // label the frames between as well
  double max_gap_s = 1.0;  // see PropagationOptions
};

// The video that is to be lifted: the only input, or without any the one that
// all frames of the labels file name, beside that file. Throws InputError for a
// video among other inputs.
std::optional<std::filesystem::path> FindVideo(const std::vector<std::string>& inputs,
                                               const std::string& labels_file);

// The labels of a video, frame by frame with their times. A frame of the labels
// belongs to the frame of the video with its `frame`, else nearest to its
// `time_s`; labels with neither belong to a video with as many frames, in order.
// Throws InputError when they do not fit.
LiftInputs GatherVideo(const std::filesystem::path& video, const VideoLabelsOptions& options,
                       const ProgressFn& progress);

}  // namespace poselift::cli
