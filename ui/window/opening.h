// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/label/frame_times.h"
#include "ui/label/label_project.h"

namespace poselift {

struct OpenedLabels {
  std::unique_ptr<LabelProject> project;
  VideoTimes times;  // of videos that had to be read for it
};

// FindLabelsFile and AddNewPictures, and where that takes a while a window that says how far it is.
// Nothing when a person has closed that: then no file is made, and none is changed. With read_only
// the file must be there, and is only looked at. Throws InputError as those.
std::optional<OpenedLabels> OpenLabels(const std::vector<std::string>& inputs,
                                       const std::string& labels_file, const std::string& layout,
                                       bool read_only = false);

}  // namespace poselift
