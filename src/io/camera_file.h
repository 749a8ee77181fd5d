// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/camera.h"

namespace poselift {

// Files of cameras, told apart by what is in them.
enum class CameraFileFormat {
  kOpenCvOrRos,  // YAML: camera_yaml.h
  kKalibr,       // YAML, camchain: cam0, cam1, ...; camera_model pinhole with radtan or none
  kAnipose,      // TOML, calibration.toml: [cam_0], ...; not with fisheye = true
};
CameraFileFormat FormatOfCameraFile(const std::filesystem::path& path);
const char* CameraFileFormatName(CameraFileFormat format);

// The cameras of a file by name, in its order: cam0 of Kalibr; of anipose its `name`, or that
// of the table. Of a file that holds one camera without a name: the empty name.
std::vector<std::string> CameraNames(const std::filesystem::path& path);

// The camera of that name, which may stand behind the file as well, as cameras.toml#cam1; of
// a file with one camera it may be empty. Throws InputError with file:line where the file's library
// knows the line, for what is malformed or implausible (Camera::Validate), a lens that Camera does
// not have, and a name that is not there.
Camera ReadCamera(const std::filesystem::path& path, const std::string& name = "");

}  // namespace poselift
