// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/camera.h"

namespace poselift {

// What camera_file.h puts together. A camera with its name in the file.
struct NamedCamera {
  std::string name;
  Camera camera;
};

// The names are read of all cameras, a camera only of the one that is wanted, which is the
// first one when `wanted` is empty: another may be one that Camera cannot be.
struct CameraList {
  std::vector<std::string> names;
  NamedCamera chosen;
};

CameraList ReadKalibrCameras(const std::filesystem::path& path, const std::string& wanted);
CameraList ReadAniposeCameras(const std::filesystem::path& path, const std::string& wanted);

// Where `wanted` stands among the names, 0 for an empty one. Throws InputError.
size_t FindCameraName(const std::filesystem::path& path, const std::vector<std::string>& names,
                      const std::string& wanted);

}  // namespace poselift
