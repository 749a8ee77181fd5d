// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/labels.h"

namespace poselift::cli {

// The labels that are to be lifted, and the picture of each frame.
struct LiftInputs {
  Labels labels;
  std::vector<std::filesystem::path> images;  // one for each frame; empty: no picture
  std::filesystem::path video;                // that all frames are of; empty: none
};

// inputs: pictures, folders of pictures, or nothing: all frames of the labels
// file. A frame belongs to the picture of its name; the only picture takes the
// only frame whatever their names. Without a labels file each picture NAME.jpg
// brings its own NAME.labels.json. Throws InputError when a picture has no
// labels.
LiftInputs GatherInputs(const std::vector<std::string>& inputs, const std::string& labels_file,
                        const std::string& layout);

}  // namespace poselift::cli
