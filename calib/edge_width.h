// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "src/tag_detection.h"

namespace poselift {

// How wide the edges of a tag are, px: from 10 to 90 % of the way from its black border to
// the white one, across the edge. A sharp picture has some 1.5 px, one that is smeared
// over b px, at most a cell, 0.8 b. First that of the top and the bottom edge, the sharper of
// them, then that of the left and the right: motion along one axis of the tag widens the
// edges across it alone.
//
// cells_of_size: TagFamily::cells_of_size(). NaN where the tag is too small (cells below 3 px),
// has no contrast, or goes out of the picture.
std::array<double, 2> EdgeWidths_px(const cv::Mat& grey, const TagDetection& tag,
                                    int cells_of_size);

}  // namespace poselift
