// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QColor>
#include <QPainterPath>
#include <Qt>
#include <opencv2/core/types.hpp>

class QPainter;

namespace poselift {

QColor ColorFrom(const cv::Scalar& bgr);

// Dark below bright: seen on any picture.
void StrokeTwice(QPainter* painter, const QPainterPath& path, const QColor& color, double width,
                 Qt::PenStyle style = Qt::SolidLine);

}  // namespace poselift
