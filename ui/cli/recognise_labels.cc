// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "src/io/labels.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

// Smallest and largest size that the file says of its pictures.
void AddPictureSizes(const Labels& labels, Json* facts) {
  std::set<int> widths_px, heights_px;
  for (const FrameLabels& frame : labels.frames) {
    if (frame.width_px > 0) widths_px.insert(frame.width_px);
    if (frame.height_px > 0) heights_px.insert(frame.height_px);
  }
  if (widths_px.empty() || heights_px.empty()) return;
  (*facts)["picture_width_px"] = {*widths_px.begin(), *widths_px.rbegin()};
  (*facts)["picture_height_px"] = {*heights_px.begin(), *heights_px.rbegin()};
}

}  // namespace

bool IsLabels(const std::filesystem::path& path, std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  std::error_code ignored;
  return head.starts_with('{') || head.starts_with('[') || HasEnding(path, ".json") ||
         std::filesystem::is_directory(path, ignored);
}

Json DescribeLabels(const std::filesystem::path& path) {
  const Labels labels = ReadLabels(path);
  std::set<std::string> images;
  size_t num_people = 0;
  std::array<size_t, 3> counts = {};
  for (const FrameLabels& frame : labels.frames) {
    if (!frame.image.empty()) images.insert(frame.image);
    num_people += frame.people.size();
    for (const PersonLabels& person : frame.people)
      for (const LandmarkLabel& landmark : person.landmarks)
        ++counts[static_cast<size_t>(landmark.state)];
  }
  Json facts = {{"layout", labels.layout},
                {"frames", labels.frames.size()},
                {"people", num_people},
                {"visible", counts[static_cast<size_t>(LabelState::kVisible)]},
                {"occluded", counts[static_cast<size_t>(LabelState::kOccluded)]},
                {"absent", counts[static_cast<size_t>(LabelState::kAbsent)]},
                {"pictures", images.size()}};
  AddPictureSizes(labels, &facts);
  return facts;
}

}  // namespace poselift::cli
