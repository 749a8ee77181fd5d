// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/still_folder.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "src/input_error.h"
#include "src/io/image.h"
#include "src/translated.h"

namespace poselift {

namespace fs = std::filesystem;

fs::path FreeName(const fs::path& folder, const std::string& stem, const std::string& ending) {
  std::error_code ignored;
  for (int number = 1;; ++number) {
    fs::path path = folder / fmt::format("{}-{:04}{}", stem, number, ending);
    if (!fs::exists(fs::symlink_status(path, ignored))) return path;
  }
}

size_t StillFolder::Add(const cv::Mat& bgr, const LabelFn& label) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw InputError(folder_.string(), "cannot be made a folder: " + error.message());
  const fs::path file = folder_ / "labels.json";
  if (!project_ && fs::exists(file, error)) project_ = std::make_unique<LabelProject>(file);
  if (project_ && project_->read_only())
    throw InputError(file.string(),
                     "found it open in another window, wanted it alone; choose another folder");
  const Layout* const layout = FindLayout(project_ ? project_->labels().layout : layout_);
  if (!layout) throw InputError(file.string(), "found labels without a layout, wanted body15");
  const fs::path picture = FreeName(folder_, "still", ".png");
  WritePng(picture, bgr);
  FrameLabels frame{
      .image = picture.filename().string(), .width_px = bgr.cols, .height_px = bgr.rows};
  std::vector<LandmarkLabel> landmarks = label ? label(*layout) : std::vector<LandmarkLabel>();
  if (!landmarks.empty()) frame.people.push_back({.id = 0, .landmarks = std::move(landmarks)});
  if (project_) {
    project_->Apply({.name = Translated("freeze {}", frame.image), .added = {std::move(frame)}});
  } else {
    CreateLabelsFile(file, {.layout = layout_, .frames = {std::move(frame)}});
    project_ = std::make_unique<LabelProject>(file);
  }
  return project_->labels().frames.size() - 1;
}

}  // namespace poselift
