// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/camera_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

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

// "cameras.toml#cam1", where no file is called so.
std::pair<std::filesystem::path, std::string> SplitName(const std::filesystem::path& path) {
  const std::string text = path.string();
  const size_t at = text.rfind('#');
  if (at == std::string::npos || std::filesystem::exists(path)) return {path, ""};
  return {text.substr(0, at), text.substr(at + 1)};
}

void CheckIsOne(const std::filesystem::path& path) {
  const std::vector<std::string> names = CameraNames(path);
  if (names.size() == 1) return;
  throw InputError(path, fmt::format("found the cameras {}, wanted one: name it behind the file, "
                                     "as {}#{}",
                                     fmt::join(names, ", "), path.string(), names.front()));
}

}  // namespace

CameraFileFormat FormatOfCameraFile(const std::filesystem::path& path) {
  const std::string text = ReadTextFile(path);
  if (HasLine(text, "camera_matrix") || HasLine(text, "image_width"))
    return CameraFileFormat::kOpenCvOrRos;
  if (HasLine(text, "camera_model:") || HasLine(text, "intrinsics:"))
    return CameraFileFormat::kKalibr;
  if (HasLine(text, "[") && HasLine(text, "matrix")) return CameraFileFormat::kAnipose;
  if (EqualsIgnoringCase(path.extension().string(), ".toml")) return CameraFileFormat::kAnipose;
  return CameraFileFormat::kOpenCvOrRos;
}

const char* CameraFileFormatName(CameraFileFormat format) {
  switch (format) {
    case CameraFileFormat::kKalibr:
      return "Kalibr camchain";
    case CameraFileFormat::kAnipose:
      return "anipose calibration";
    case CameraFileFormat::kOpenCvOrRos:
      break;
  }
  return "OpenCV or ROS camera";
}

std::vector<std::string> CameraNames(const std::filesystem::path& path) {
  switch (FormatOfCameraFile(path)) {
    case CameraFileFormat::kKalibr:
      return ReadKalibrCameras(path, "").names;
    case CameraFileFormat::kAnipose:
      return ReadAniposeCameras(path, "").names;
    case CameraFileFormat::kOpenCvOrRos:
      break;
  }
  return {""};
}

Camera ReadCamera(const std::filesystem::path& path, const std::string& name) {
  if (const auto [file, named] = SplitName(path); name.empty() && !named.empty())
    return ReadCamera(file, named);
  if (name.empty()) CheckIsOne(path);
  switch (FormatOfCameraFile(path)) {
    case CameraFileFormat::kKalibr:
      return ReadKalibrCameras(path, name).chosen.camera;
    case CameraFileFormat::kAnipose:
      return ReadAniposeCameras(path, name).chosen.camera;
    case CameraFileFormat::kOpenCvOrRos:
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
