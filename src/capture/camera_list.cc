// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/camera_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <system_error>

#include "src/capture/v4l2_device.h"
#include "src/input_error.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

// "/dev/video10" -> 10; nothing of the kind -> -1.
int NumberOf(const fs::path& path) {
  constexpr std::string_view kVideo = "video";
  constexpr size_t kMostDigits = 6;
  const std::string name = path.filename();
  const std::string digits = name.substr(std::min(name.size(), kVideo.size()));
  const bool is_node = name.rfind(kVideo, 0) == 0 && !digits.empty() &&
                       digits.size() <= kMostDigits &&
                       std::all_of(digits.begin(), digits.end(),
                                   [](unsigned char letter) { return std::isdigit(letter); });
  return is_node ? std::stoi(digits) : -1;
}

std::vector<fs::path> ListFolder(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    paths.push_back(at->path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

// By the number of the node they lead to.
std::map<int, std::vector<std::string>> ListStablePaths(const fs::path& dev_folder) {
  std::map<int, std::vector<std::string>> paths;
  for (const char* folder : {"by-id", "by-path"})
    for (const fs::path& link : ListFolder(dev_folder / "v4l" / folder)) {
      std::error_code error;
      const fs::path node = fs::read_symlink(link, error);
      if (!error) paths[NumberOf(node)].push_back(link);
    }
  return paths;
}

}  // namespace

std::vector<CameraInfo> ListCameras(SystemCalls* system, const fs::path& dev_folder) {
  std::map<int, std::vector<std::string>> stable_paths = ListStablePaths(dev_folder);
  std::map<int, fs::path> nodes;
  for (const fs::path& path : ListFolder(dev_folder))
    if (const int number = NumberOf(path); number >= 0) nodes[number] = path;

  std::vector<CameraInfo> cameras;
  for (const auto& [number, path] : nodes) {
    CameraInfo camera;
    camera.path = path;
    camera.stable_paths = stable_paths[number];
    try {
      const V4l2Device device(path, system);
      camera.name = device.name();
      camera.driver = device.driver();
      camera.bus = device.bus();
      camera.formats = ListFormats(device);
    } catch (const NoCamera&) {
      continue;
    } catch (const InputError& error) {
      camera.problem = error.what();
    }
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

}  // namespace poselift
