// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/io/poses_json.h"
#include "ui/cli/recognisers.h"
#include "ui/cli/truth.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

void AddErrors(std::vector<double> reprojection_rms_px, Json* facts) {
  if (reprojection_rms_px.empty()) return;
  const auto middle = reprojection_rms_px.begin() + std::ssize(reprojection_rms_px) / 2;
  std::nth_element(reprojection_rms_px.begin(), middle, reprojection_rms_px.end());
  (*facts)["median_rms_px"] = *middle;
  (*facts)["largest_rms_px"] =
      *std::max_element(reprojection_rms_px.begin(), reprojection_rms_px.end());
}

void AddTimes(const Poses& poses, Json* facts) {
  double first_s = HUGE_VAL, last_s = -HUGE_VAL;
  for (const FramePoses& frame : poses.frames) {
    if (!frame.time_s) continue;
    first_s = std::min(first_s, *frame.time_s);
    last_s = std::max(last_s, *frame.time_s);
  }
  if (first_s <= last_s) (*facts)["time_s"] = {first_s, last_s};
}

}  // namespace

// All of ours say the format in the first line.
bool IsPoses(const std::filesystem::path&, std::string_view head) {
  return head.find("\"poselift-poses\"") != std::string_view::npos;
}

Json DescribePoses(const std::filesystem::path& path) {
  const Poses poses = ReadPosesJson(path);
  size_t num_people = 0;
  std::vector<double> reprojection_rms_px;
  Json statuses = Json::object();
  for (const FramePoses& frame : poses.frames)
    for (const PersonPose& person : frame.people) {
      ++num_people;
      statuses[person.status] = statuses.value(person.status, 0) + 1;
      if (std::isfinite(person.reprojection_rms_px))
        reprojection_rms_px.push_back(person.reprojection_rms_px);
    }
  Json facts = {{"frames", poses.frames.size()},
                {"people", num_people},
                {"ok", statuses.value("ok", 0)},
                {"statuses", statuses}};
  AddErrors(std::move(reprojection_rms_px), &facts);
  AddTimes(poses, &facts);
  return facts;
}

// Lifted poses have these joints too, and stand before it in the table.
bool IsTruth(const std::filesystem::path&, std::string_view head) {
  return head.find("\"joints_in_cam\"") != std::string_view::npos;
}

Json DescribeTruth(const std::filesystem::path& path) {
  return {{"joints", ReadTruth(path).landmarks.size()}};
}

}  // namespace poselift::cli
