// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core.hpp>

namespace poselift::testing {

// Samples of what the drawing code drew, on 8-bit BGR.

inline cv::Vec3b At(const cv::Mat& picture, double x_px, double y_px) {
  return picture.at<cv::Vec3b>(cvRound(y_px), cvRound(x_px));
}

inline bool SamePicture(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

// The colours of the left and the right side, also when pale.
inline bool IsLeftBlue(const cv::Vec3b& bgr) { return bgr[0] > bgr[2] + 50; }
inline bool IsRightOrange(const cv::Vec3b& bgr) { return bgr[2] > bgr[0] + 50; }

}  // namespace poselift::testing
