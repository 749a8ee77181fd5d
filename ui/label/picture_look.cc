// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/picture_look.h"

#include <algorithm>
#include <cmath>

namespace poselift {

cv::Mat1b PictureLook::Table() const {
  cv::Mat1b table(1, 256);
  for (int grey = 0; grey < 256; ++grey) {
    const double g = (grey / 255.0 - 0.5) * contrast + 0.5 + brightness;
    table(grey) = cv::saturate_cast<uchar>(255.0 * std::pow(std::clamp(g, 0.0, 1.0), 1.0 / gamma));
  }
  return table;
}

}  // namespace poselift
