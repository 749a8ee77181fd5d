// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lift/lift_photo.h"
#include "src/camera.h"
#include "src/labels.h"
#include "src/layout.h"

namespace poselift::cli {

// Everybody over the picture; camera: what the poses were lifted with.
cv::Mat DrawPeople(const cv::Mat& picture, const FrameLabels& frame, const Layout& layout,
                   const std::vector<LiftResult>& results, const std::optional<Camera>& camera);

// The 3D views of the first person who was lifted; empty when nobody was.
cv::Mat DrawFirstView(const std::vector<LiftResult>& results, const std::string& title);

// NAME.overlay.png (everybody in the picture) and NAME.view.png (the first
// person who was lifted) in out_dir, NAME being the picture's name without its
// ending. Throws InputError when the picture is none.
void WritePictures(const std::filesystem::path& image, const FrameLabels& frame,
                   const Layout& layout, const std::vector<LiftResult>& results,
                   const std::optional<Camera>& camera, const std::filesystem::path& out_dir);

}  // namespace poselift::cli
