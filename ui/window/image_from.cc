// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/image_from.h"

namespace poselift {

QImage ImageFrom(const cv::Mat& bgr) {
  if (bgr.empty()) return {};
  return QImage(bgr.data, bgr.cols, bgr.rows, static_cast<qsizetype>(bgr.step),
                QImage::Format_BGR888)
      .convertToFormat(QImage::Format_RGB32);
}

QImage EmptyPicture(const QSize& size_px) {
  QImage picture(size_px, QImage::Format_Mono);  // a large one takes no room while another is read
  picture.setColorTable({qRgb(236, 236, 232), qRgb(0, 0, 0)});
  picture.fill(0);
  return picture;
}

}  // namespace poselift
