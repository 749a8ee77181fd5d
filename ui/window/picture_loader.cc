// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/picture_loader.h"

#include <opencv2/core/mat.hpp>

#include "src/io/image.h"

namespace poselift {

QImage LoadPicture(const std::filesystem::path& path) {
  if (path.empty()) return {};
  const cv::Mat bgr = ReadImage(path);
  return QImage(bgr.data, bgr.cols, bgr.rows, static_cast<qsizetype>(bgr.step),
                QImage::Format_BGR888)
      .convertToFormat(QImage::Format_RGB32);
}

}  // namespace poselift
