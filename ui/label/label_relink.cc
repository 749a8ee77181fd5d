// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_relink.h"

#include <map>
#include <string>

#include "src/translated.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

bool IsThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// In the folder, by as much of the end of its path as helps; empty when it is not there.
fs::path FindByEnd(const fs::path& image, const fs::path& folder) {
  const fs::path whole = image.relative_path();
  for (auto first = whole.begin(); first != whole.end(); ++first) {
    fs::path end;
    for (auto part = first; part != whole.end(); ++part) end /= *part;
    if (IsThere(folder / end)) return folder / end;
  }
  return {};
}

std::string RelativeTo(const fs::path& dir, const fs::path& path) {
  std::error_code ignored;
  const fs::path relative = fs::proximate(path, dir, ignored);
  return (relative.empty() ? path : relative).generic_string();
}

}  // namespace

fs::path ImagePath(const FrameLabels& frame, const fs::path& labels_dir) {
  return frame.image.empty() ? fs::path() : labels_dir / frame.image;
}

std::vector<size_t> FramesWithoutImage(const Labels& labels, const fs::path& labels_dir) {
  std::map<std::string, bool> is_there;  // the frames of a video share one
  std::vector<size_t> missing;
  for (size_t i = 0; i < labels.frames.size(); ++i) {
    const FrameLabels& frame = labels.frames[i];
    if (frame.image.empty()) continue;
    const auto [known, is_new] = is_there.try_emplace(frame.image);
    if (is_new) known->second = IsThere(ImagePath(frame, labels_dir));
    if (!known->second) missing.push_back(i);
  }
  return missing;
}

LabelEdit RelinkImages(const Labels& labels, const fs::path& labels_dir, const fs::path& folder) {
  const std::vector<size_t> missing = FramesWithoutImage(labels, labels_dir);
  std::map<std::string, fs::path> found;
  for (const size_t i : missing) {
    const auto [known, is_new] = found.try_emplace(labels.frames[i].image);
    if (is_new) known->second = FindByEnd(known->first, folder);
  }
  std::map<fs::path, int> times_taken;
  for (const auto& [image, path] : found) ++times_taken[path];
  LabelEdit edit;
  edit.name = Translated("look for pictures in {}", folder.filename().string());
  for (const size_t i : missing) {
    const fs::path& path = found.at(labels.frames[i].image);
    if (!path.empty() && times_taken[path] == 1) edit.images[i] = RelativeTo(labels_dir, path);
  }
  return edit;
}

Labels WithImagesFrom(Labels labels, const fs::path& old_labels_dir,
                      const fs::path& new_labels_dir) {
  for (FrameLabels& frame : labels.frames)
    if (!frame.image.empty() && fs::path(frame.image).is_relative())
      frame.image = RelativeTo(new_labels_dir, ImagePath(frame, old_labels_dir));
  return labels;
}

}  // namespace poselift
