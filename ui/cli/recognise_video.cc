// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/io/image_folder.h"
#include "src/io/video.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {

using Json = nlohmann::ordered_json;

bool IsVideoOfFrames(const std::filesystem::path&, std::string_view head) { return IsVideo(head); }

// Of the frames themselves: what a container states is often an estimate.
Json DescribeVideo(const std::filesystem::path& path) {
  VideoFile video(path, Pictures::kGrey);
  std::vector<double> times_s;
  while (const auto time_s = video.Skip_s()) times_s.push_back(*time_s);
  Json facts = {{"width_px", video.size_px().width},
                {"height_px", video.size_px().height},
                {"frames", times_s.size()}};
  if (times_s.size() < 2) return facts;
  const double frame_s =
      (times_s.back() - times_s.front()) / static_cast<double>(times_s.size() - 1);
  facts["rate_hz"] = 1.0 / frame_s;
  facts["duration_s"] = static_cast<double>(times_s.size()) * frame_s;
  double shortest_s = frame_s, longest_s = frame_s;
  for (size_t i = 1; i < times_s.size(); ++i) {
    shortest_s = std::min(shortest_s, times_s[i] - times_s[i - 1]);
    longest_s = std::max(longest_s, times_s[i] - times_s[i - 1]);
  }
  facts["between_frames_s"] = {shortest_s, longest_s};
  return facts;
}

bool IsPictureFolder(const std::filesystem::path& path, std::string_view) {
  bool has_pictures = false;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(path, ignored)) {
    if (entry.path().string().ends_with("_keypoints.json")) return false;  // of OpenPose: labels
    has_pictures = has_pictures || HasImageEnding(entry.path());
  }
  return has_pictures;
}

// Of the first picture; a command that reads them all finds the one that is damaged.
Json DescribePictureFolder(const std::filesystem::path& path) {
  const ImageFolder folder(path, 1.0, Pictures::kGrey);
  return {{"pictures", folder.files().size()},
          {"width_px", folder.size_px().width},
          {"height_px", folder.size_px().height},
          {"first", folder.files().front().filename().string()},
          {"last", folder.files().back().filename().string()}};
}

}  // namespace poselift::cli
