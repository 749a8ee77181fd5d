// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/capture/camera_formats.h"

namespace poselift {

struct CameraInfo {
  std::string path;  // "/dev/video0", which may be another camera's after the next start
  // That stay: by-id (the same camera in any port), then by-path (any camera in the port).
  std::vector<std::string> stable_paths;
  std::string name, driver, bus;
  std::vector<CameraFormat> formats;
  std::string problem;  // why it cannot be asked; then the rest is empty
};

// The cameras of this machine by number, without the nodes that give no pictures.
std::vector<CameraInfo> ListCameras(SystemCalls* system = RealSystem(),
                                    const std::filesystem::path& dev_folder = "/dev");

}  // namespace poselift
