// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "src/camera.h"
#include "src/tag_detection.h"

namespace poselift {

// A tag on the picture that shows it (8-bit BGR): its outline, its id, a mark at its top left
// corner; with a camera and a pose half a size of its axes as well: x red, y green, z, into
// the paper, blue. An ambiguous one is dashed.
void DrawTag(const TagSighting& tag, double size_m, const std::optional<Camera>& camera,
             cv::Mat* picture);

}  // namespace poselift
