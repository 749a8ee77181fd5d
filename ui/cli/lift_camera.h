// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/camera.h"
#include "src/labels.h"

namespace CLI {
class App;
}

namespace poselift::cli {

// What a person says of the camera that took the pictures; nothing is weak perspective.
struct LiftCamera {
  std::string file;                         // calibrated
  std::optional<double> fov_deg, focal_px;  // or about so wide, or of about this focal length
  bool by_exif = false;                     // or as it wrote into the first picture
};

void AddLiftCamera(CLI::App* command, LiftCamera* camera);

// That of the frames, at their size. Throws InputError for pictures of several sizes, of which no
// size is known, of another shape than the file's, or without a focal length in their EXIF.
std::optional<Camera> CameraOf(const LiftCamera& said, const Labels& labels,
                               const std::vector<std::filesystem::path>& images);

}  // namespace poselift::cli
