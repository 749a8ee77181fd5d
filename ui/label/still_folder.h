// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "src/layout.h"
#include "ui/label/label_project.h"

namespace poselift {

// The first of stem-0001ending, stem-0002ending, ... that the folder does not have.
std::filesystem::path FreeName(const std::filesystem::path& folder, const std::string& stem,
                               const std::string& ending);

// Stills of a camera and their labels: still-0001.png, ... and labels.json, which
// `poselift label FOLDER` opens too.
class StillFolder {
 public:
  // layout: of new labels; a labels.json that is there has its own. Nothing is read yet.
  StillFolder(std::filesystem::path folder, std::string layout)
      : folder_(std::move(folder)), layout_(std::move(layout)) {}

  // Writes the picture (BGR) and adds it as a frame, with the landmarks that `label` gives for the
  // layout as its person's, if it gives any. Returns the frame's index. Throws InputError when
  // something cannot be written, or somebody else works on the labels.
  using LabelFn = std::function<std::vector<LandmarkLabel>(const Layout& layout)>;
  size_t Add(const cv::Mat& bgr, const LabelFn& label);

  const std::filesystem::path& folder() const { return folder_; }
  LabelProject* project() { return project_.get(); }  // null before the first still

 private:
  std::filesystem::path folder_;
  std::string layout_;
  std::unique_ptr<LabelProject> project_;
};

}  // namespace poselift
