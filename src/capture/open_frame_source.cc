// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/open_frame_source.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "src/input_error.h"
#include "src/io/image_folder.h"
#include "src/io/video.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

bool IsNumber(const std::string& name) {
  constexpr size_t kMostDigits = 4;
  return !name.empty() && name.size() <= kMostDigits &&
         std::all_of(name.begin(), name.end(),
                     [](char letter) { return letter >= '0' && letter <= '9'; });
}

}  // namespace

SourceKind KindOfSource(const std::string& name) {
  std::error_code error;
  const fs::file_status status = fs::status(name, error);
  if (fs::is_character_file(status) || name.rfind("/dev/", 0) == 0) return SourceKind::kCamera;
  if (fs::is_directory(status)) return SourceKind::kFolder;
  if (!fs::exists(status)) {
    if (IsNumber(name)) return SourceKind::kCamera;
    throw InputError(name,
                     "no such file; wanted a camera (/dev/video0), a video, a folder of "
                     "pictures or a picture");
  }
  if (IsVideoFile(name)) return SourceKind::kVideo;
  return HasImageEnding(name) ? SourceKind::kImage : SourceKind::kVideo;
}

std::string DevicePath(const std::string& name) {
  return IsNumber(name) ? "/dev/video" + name : name;
}

std::unique_ptr<FrameSource> OpenFrameSource(const std::string& name,
                                             const FrameSourceOptions& options,
                                             SystemCalls* system) {
  switch (KindOfSource(name)) {
    case SourceKind::kVideo:
      return std::make_unique<VideoFile>(name, options.pictures);
    case SourceKind::kFolder:
    case SourceKind::kImage:
      return std::make_unique<ImageFolder>(name, options.folder_rate_hz, options.pictures);
    case SourceKind::kCamera:
      break;
  }
  LiveOptions live = options.live;
  live.pictures = options.pictures;
  return std::make_unique<LiveFrameSource>(DevicePath(name), live, system);
}

}  // namespace poselift
