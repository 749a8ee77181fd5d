// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <vector>

#include "src/labels.h"
#include "ui/label/label_history.h"

namespace poselift {

// Pictures of labels: their paths are relative to the folder of the labels file, or absolute.

// As the system wants it; empty for a frame without a picture.
std::filesystem::path ImagePath(const FrameLabels& frame, const std::filesystem::path& labels_dir);

// The frames whose picture, or video, is not there.
std::vector<size_t> FramesWithoutImage(const Labels& labels,
                                       const std::filesystem::path& labels_dir);

// Looks in the folder for the pictures that are not there: a/b/c.jpg as a/b/c.jpg, else b/c.jpg,
// else c.jpg. Where two pictures would become the same file, neither is taken. The edit has the
// new path of each frame found, relative to labels_dir; it changes nothing when none was.
LabelEdit RelinkImages(const Labels& labels, const std::filesystem::path& labels_dir,
                       const std::filesystem::path& folder);

// The paths for a labels file in another folder.
Labels WithImagesFrom(Labels labels, const std::filesystem::path& old_labels_dir,
                      const std::filesystem::path& new_labels_dir);

}  // namespace poselift
