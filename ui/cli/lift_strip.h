// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "lift/lift_photo.h"
#include "src/camera.h"
#include "src/progress.h"
#include "ui/cli/lift_inputs.h"

namespace poselift::cli {

// NAME.strip.png in out_dir: some 12 frames of the video's lifted ones, evenly
// spread, each with the lifted people over the cut-out picture and the first
// one's 3D views below it. With whole_video also NAME.overlay.avi (Motion JPEG),
// all of them, at an even rate. results: [frame][person]. Throws InputError
// when a file cannot be written.
void WriteVideoPictures(const LiftInputs& inputs,
                        const std::vector<std::vector<LiftResult>>& results,
                        const std::optional<Camera>& camera, bool whole_video,
                        const std::filesystem::path& out_dir, const ProgressFn& progress);

}  // namespace poselift::cli
