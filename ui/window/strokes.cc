// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/strokes.h"

#include <QPainter>
#include <QPen>

#include "src/draw/style.h"

namespace poselift {

QColor ColorFrom(const cv::Scalar& bgr) {
  return {static_cast<int>(bgr[2]), static_cast<int>(bgr[1]), static_cast<int>(bgr[0])};
}

void StrokeTwice(QPainter* painter, const QPainterPath& path, const QColor& color, double width,
                 Qt::PenStyle style) {
  painter->setBrush(Qt::NoBrush);
  painter->setPen(QPen(ColorFrom(palette::kInk), width + 2.0, Qt::SolidLine, Qt::RoundCap));
  painter->drawPath(path);
  painter->setPen(QPen(color, width, style, style == Qt::SolidLine ? Qt::RoundCap : Qt::FlatCap));
  painter->drawPath(path);
}

}  // namespace poselift
