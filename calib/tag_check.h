// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "src/capture/source_facts.h"

namespace poselift {

// Whether pictures show tags of a family, as they are or mirrored, and how sharp those are.
// grey: 8-bit. Throws InputError for an unknown family.
TagFacts CheckTags(const std::vector<cv::Mat>& grey, const std::string& family);

}  // namespace poselift
