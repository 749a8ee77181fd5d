// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/camera_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/input_error.h"
#include "src/io/camera_formats.h"
#include "src/io/camera_yaml.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

// Whether some line begins with this, but for blanks.
bool HasLine(const std::string& text, std::string_view beginning) {
  for (size_t at = text.find(beginning); at != std::string::npos;
       at = text.find(beginning, at + 1)) {
    const size_t before = text.find_last_not_of(" \t", at == 0 ? 0 : at - 1);
    if (at == 0 || before == std::string::npos || text[before] == '\n') return true;
  }
  return false;
}

}  // namespace

CameraFormat FormatOfCameraFile(const std::filesystem::path& path) {
  const std::string text = ReadTextFile(path);
  if (HasLine(text, "camera_matrix") || HasLine(text, "image_width"))
    return CameraFormat::kOpenCvOrRos;
  if (HasLine(text, "camera_model:") || HasLine(text, "intrinsics:")) return CameraFormat::kKalibr;
  if (HasLine(text, "[") && HasLine(text, "matrix")) return CameraFormat::kAnipose;
  if (EqualsIgnoringCase(path.extension().string(), ".toml")) return CameraFormat::kAnipose;
  return CameraFormat::kOpenCvOrRos;
}

const char* CameraFormatName(CameraFormat format) {
  switch (format) {
    case CameraFormat::kKalibr:
      return "Kalibr camchain";
    case CameraFormat::kAnipose:
      return "anipose calibration";
    case CameraFormat::kOpenCvOrRos:
      break;
  }
  return "OpenCV or ROS camera";
}

std::vector<std::string> CameraNames(const std::filesystem::path& path) {
  switch (FormatOfCameraFile(path)) {
    case CameraFormat::kKalibr:
      return ReadKalibrCameras(path, "").names;
    case CameraFormat::kAnipose:
      return ReadAniposeCameras(path, "").names;
    case CameraFormat::kOpenCvOrRos:
      break;
  }
  return {""};
}

Camera ReadCamera(const std::filesystem::path& path, const std::string& name) {
  switch (FormatOfCameraFile(path)) {
    case CameraFormat::kKalibr:
      return ReadKalibrCameras(path, name).chosen.camera;
    case CameraFormat::kAnipose:
      return ReadAniposeCameras(path, name).chosen.camera;
    case CameraFormat::kOpenCvOrRos:
      break;
  }
  FindCameraName(path, {""}, name);
  return ReadCameraYaml(path);
}

size_t FindCameraName(const std::filesystem::path& path, const std::vector<std::string>& names,
                      const std::string& wanted) {
  if (wanted.empty()) return 0;
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  std::string known;
  for (const std::string& name : names)
    if (!name.empty()) known += (known.empty() ? "" : ", ") + name;
  throw InputError(path, fmt::format("found no camera {}, wanted {}", Quoted(wanted),
                                     known.empty() ? "none named: the file holds one camera"
                                                   : "one of " + known));
}

}  // namespace poselift
