// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QImage>
#include <opencv2/core/mat.hpp>

namespace poselift {

// A BGR picture for the screen.
QImage ImageFrom(const cv::Mat& bgr);

// The ground that a pose without a picture is shown on; null for no size.
QImage EmptyPicture(const QSize& size_px);

}  // namespace poselift
