// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>

#include "src/poses.h"

namespace poselift::cli {

// Prints how far the first person of the first frame is from the truth file
// ({"units": "m", "joints_in_cam": {joint: [x, y, z], ...}}; docs/FORMATS.md),
// over the joints that the file names: PA and CAM (lift/eval/pose_error.h).
void PrintErrorAgainstTruth(const Poses& poses, const std::filesystem::path& truth);

}  // namespace poselift::cli
