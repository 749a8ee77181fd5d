// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/orbit_canvas.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/draw/style.h"
#include "ui/window/strokes.h"

namespace poselift {
namespace {

constexpr double kTurn_rad = 0.009;  // a pixel of the mouse
constexpr double kStep_rad = 0.15;   // a key
constexpr int kSmallest = 160, kLargest = 2000;
constexpr double kLowest_rad = -0.4, kHighest_rad = std::numbers::pi / 2.0 - 0.01;

}  // namespace

OrbitCanvas::OrbitCanvas(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("3D pose"));
  setToolTip(tr("Drag to turn, wheel to zoom, double click for the camera's view"));
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(kSmallest, kSmallest);
}

int OrbitCanvas::Side_px() const {
  return std::clamp(static_cast<int>(devicePixelRatioF() * std::min(width(), height())), kSmallest,
                    kLargest);
}

Eigen::Vector2d OrbitCanvas::ToPanel(const QPointF& x_in_widget) const {
  const double ratio = devicePixelRatioF(), side = Side_px() / ratio;
  return ratio * Eigen::Vector2d(x_in_widget.x() - (width() - side) / 2.0,
                                 x_in_widget.y() - (height() - side) / 2.0);
}

QPointF OrbitCanvas::ToWidget(const Eigen::Vector2d& x_px) const {
  const double ratio = devicePixelRatioF(), side = Side_px() / ratio;
  return {x_px.x() / ratio + (width() - side) / 2.0, x_px.y() / ratio + (height() - side) / 2.0};
}

void OrbitCanvas::PaintPanel(QPainter* painter, const cv::Mat& panel) const {
  painter->fillRect(rect(), ColorFrom(palette::kPaper));
  const QImage image(panel.data, panel.cols, panel.rows, static_cast<int>(panel.step),
                     QImage::Format_BGR888);
  painter->drawImage(QRectF(ToWidget({0.0, 0.0}), ToWidget({Side_px(), Side_px()})), image);
}

void OrbitCanvas::PaintMessage(QPainter* painter, const QString& message) const {
  painter->fillRect(rect(), ColorFrom(palette::kPaper));
  painter->setPen(Qt::black);
  painter->drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, message);
}

void OrbitCanvas::Turn(double yaw_rad, double pitch_rad) {
  orbit_.yaw_rad = std::remainder(orbit_.yaw_rad + yaw_rad, 2.0 * std::numbers::pi);
  orbit_.pitch_rad = std::clamp(orbit_.pitch_rad + pitch_rad, kLowest_rad, kHighest_rad);
  update();
}

void OrbitCanvas::mousePressEvent(QMouseEvent* event) { turned_from_ = event->position(); }

void OrbitCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (!turned_from_ || event->buttons() == Qt::NoButton) return;
  const QPointF by = event->position() - *turned_from_;
  turned_from_ = event->position();
  Turn(-kTurn_rad * by.x(), kTurn_rad * by.y());
}

void OrbitCanvas::mouseReleaseEvent(QMouseEvent* /*event*/) { turned_from_.reset(); }

void OrbitCanvas::mouseDoubleClickEvent(QMouseEvent* /*event*/) {
  orbit_ = {.yaw_rad = 0.0, .pitch_rad = 0.0};
  update();
}

void OrbitCanvas::wheelEvent(QWheelEvent* event) {
  orbit_.zoom = std::clamp(orbit_.zoom * std::pow(2.0, event->angleDelta().y() / 480.0), 0.2, 20.0);
  update();
}

void OrbitCanvas::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Left:
      return Turn(kStep_rad, 0.0);
    case Qt::Key_Right:
      return Turn(-kStep_rad, 0.0);
    case Qt::Key_Up:
      return Turn(0.0, kStep_rad);
    case Qt::Key_Down:
      return Turn(0.0, -kStep_rad);
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace poselift
