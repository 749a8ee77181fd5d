// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/pose3.h"
#include "src/poses.h"

namespace poselift::cli {

// Known places of landmarks of body15.
struct Truth {
  std::vector<int> landmarks;  // rows of the layout
  Pose3 x_in_cam_m;            // 3 x landmarks
};

// {"units": "m", "joints_in_cam": {joint: [x, y, z], ...}}; docs/FORMATS.md.
// Throws InputError, also for fewer than four joints of body15.
Truth ReadTruth(const std::filesystem::path& path);

// Prints how far the first person of the first frame is from the truth, over
// the joints that it names: PA and CAM (lift/eval/pose_error.h).
void PrintErrorAgainstTruth(const Poses& poses, const Truth& truth);

}  // namespace poselift::cli
