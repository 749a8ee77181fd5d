// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/io/json_value.h"
#include "src/io/mapped_file.h"
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

// A stream of `track` or `smooth`: a frame on each line.
Poses ReadStream(const std::filesystem::path& path) {
  const MappedFile file(path);
  std::string_view text = file.Bytes();
  Poses poses;
  for (int line = 1; !text.empty(); ++line) {
    const size_t end = std::min(text.find('\n'), text.size());
    poses.frames.push_back(ReadFramePosesLine(text.substr(0, end), path.string(), line));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return poses;
}

bool IsStream(std::string_view head) {
  constexpr size_t kFirstKeys = 200;
  return head.substr(0, kFirstKeys).find("\"people\"") != std::string_view::npos &&
         head.find("\"frames\"") == std::string_view::npos &&
         head.find("\"status\"") != std::string_view::npos;
}

// Joints over time beside a video that was made: samples/tags/truth.json.
Json DescribeTruthOverTime(const JsonValue& frames) {
  Json facts = {{"frames", frames.Items().size()}};
  if (frames.Items().empty()) return facts;
  const JsonValue &first = frames.Items().front(), &last = frames.Items().back();
  facts["joints"] = first.At("joints_in_cam").Keys().size();
  if (first.Find("time_s"))
    facts["time_s"] = {first.At("time_s").Number(), last.At("time_s").Number()};
  return facts;
}

}  // namespace

// All of ours say the format in the first line, but for a stream.
bool IsPoses(const std::filesystem::path& path, std::string_view head) {
  return head.find("\"poselift-poses\"") != std::string_view::npos || HasEnding(path, ".jsonl") ||
         IsStream(head);
}

Json DescribePoses(const std::filesystem::path& path) {
  const MappedFile file(path);
  const bool is_whole = file.Bytes().substr(0, 200).find("\"poselift-poses\"") != std::string::npos;
  const Poses poses = is_whole ? ReadPosesJson(path) : ReadStream(path);
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
  Json facts = {{"format", is_whole ? "poses.json" : "JSON lines, a frame each"},
                {"frames", poses.frames.size()},
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
  const JsonDocument document(path);
  if (const JsonValue* frames = document.root().Find("frames"))
    return DescribeTruthOverTime(*frames);
  return {{"joints", ReadTruth(path).landmarks.size()}};
}

}  // namespace poselift::cli
