// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ui/label/frame_times.h"

namespace poselift {

struct OpenedLabels {
  std::filesystem::path file;
  VideoTimes times;  // of videos that had to be read for it
};

// FindLabelsFile, and where that takes a while a window that says how far it is. Nothing when a
// person has closed that: then no file is made. Throws InputError as FindLabelsFile.
std::optional<OpenedLabels> OpenLabels(const std::vector<std::string>& inputs,
                                       const std::string& labels_file, const std::string& layout);

}  // namespace poselift
