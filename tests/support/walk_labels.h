// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>

#include "src/labels.h"

namespace poselift::testing {

// A part of the labels of a walk, at 30 Hz, with a gap: three frames from `gap` on have nobody
// (none when it is negative). Without the video.
Labels ShortWalk(int num_frames, int gap);

// A labels file of them in the folder, that nobody has worked on.
std::filesystem::path FreshLabelsFile(const std::filesystem::path& folder, const Labels& labels);

}  // namespace poselift::testing
