// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "lift/lift_photo.h"
#include "src/camera.h"
#include "src/labels.h"
#include "src/layout.h"

namespace poselift::cli {

// NAME.overlay.png (everybody in the picture) and NAME.view.png (the first
// person who was lifted) in out_dir, NAME being the picture's name without its
// ending. camera: what the poses were lifted with. Throws InputError when the picture is none.
void WritePictures(const std::filesystem::path& image, const FrameLabels& frame,
                   const Layout& layout, const std::vector<LiftResult>& results,
                   const std::optional<Camera>& camera, const std::filesystem::path& out_dir);

}  // namespace poselift::cli
