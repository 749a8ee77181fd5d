// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/labels.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "src/io/json_value.h"
#include "src/io/labels_formats.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

constexpr std::string_view kOpenPoseEnding = "_keypoints.json";

const Layout* LayoutOrAuto(std::string_view name) {
  if (name == "auto") return nullptr;
  if (const Layout* layout = FindLayout(name)) return layout;
  std::string known;
  for (const Layout& layout : AllLayouts()) known += fmt::format(", {}", layout.name);
  throw InputError(fmt::format("found the layout {}, wanted auto{}", Quoted(name), known));
}

std::vector<std::filesystem::path> OpenPoseFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().string().ends_with(kOpenPoseEnding))
      files.push_back(entry->path());
  if (error) throw InputError(folder.string(), "cannot list it: " + error.message());
  if (files.empty())
    throw InputError(folder.string(),
                     "found no file *_keypoints.json, wanted a labels file or a folder of "
                     "OpenPose's files");
  std::sort(files.begin(), files.end());
  return files;
}

// layout: what the frames were found to have; null when nobody is in any.
Labels OpenPoseLabels(std::vector<FrameLabels> frames, const Layout* layout,
                      const std::string& file) {
  Labels labels{layout ? std::string(layout->name) : "openpose25", std::move(frames)};
  RefuseRelativeScale(labels, file);
  return labels;
}

Labels ReadOpenPoseFolder(const std::filesystem::path& folder, const Layout* layout) {
  std::vector<FrameLabels> frames;
  for (const std::filesystem::path& file : OpenPoseFiles(folder)) {
    const JsonDocument document(file);
    if (!IsOpenPose(document.root()))
      throw document.root().Error("found no \"people\", wanted a file that OpenPose wrote");
    frames.push_back(ReadOpenPoseFrame(document.root(), &layout));
  }
  return OpenPoseLabels(std::move(frames), layout, folder.string());
}

// What stands in a file that has no labels: its kind, and an object's first keys.
std::string Contents(const JsonValue& root) {
  if (root.Is(JsonValue::Kind::kArray)) return "a list";
  if (!root.Is(JsonValue::Kind::kObject)) return "a single value";
  constexpr size_t kMostKeys = 5;
  const std::vector<std::string>& keys = root.Keys();
  std::string text = keys.empty() ? "an empty object" : "an object with ";
  for (size_t i = 0; i < std::min(keys.size(), kMostKeys); ++i)
    text += (i > 0 ? ", " : "") + Quoted(keys[i]);
  return text + (keys.size() > kMostKeys ? ", ..." : "");
}

}  // namespace

Labels ReadLabels(const std::filesystem::path& path, std::string_view layout_name) {
  const Layout* layout = LayoutOrAuto(layout_name);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return ReadOpenPoseFolder(path, layout);
  const JsonDocument document(path);
  const JsonValue& root = document.root();
  if (IsNativeLabels(root)) return ReadNativeLabels(root, layout);
  if (IsCocoLabels(root)) return ReadCocoLabels(root, layout);
  if (IsOpenPose(root)) {
    FrameLabels frame = ReadOpenPoseFrame(root, &layout);
    return OpenPoseLabels({std::move(frame)}, layout, path.string());
  }
  throw root.Error("found JSON without labels (" + Contents(root) +
                   "), wanted poselift-labels (\"format\"), COCO keypoints (\"annotations\", or a "
                   "list of results) or OpenPose (\"people\")");
}

LandmarkLabel LandmarkFromScore(std::string_view name, const Eigen::Vector2d& x_px, double score) {
  LandmarkLabel landmark{std::string(name), x_px, LabelState::kVisible, std::nullopt};
  if (score <= 0.0)
    landmark.state = LabelState::kAbsent;
  else if (score < kGuessedBelowScore)
    landmark.state = LabelState::kOccluded;
  return landmark;
}

const Layout* FindLayoutBySize(size_t num_landmarks) {
  for (const Layout& layout : AllLayouts())
    if (layout.landmarks.size() == num_landmarks) return &layout;
  return nullptr;
}

std::string LayoutSizes() {
  std::string sizes;
  for (const Layout& layout : AllLayouts())
    sizes +=
        fmt::format("{}{} ({})", sizes.empty() ? "" : ", ", layout.name, layout.landmarks.size());
  return sizes;
}

}  // namespace poselift
