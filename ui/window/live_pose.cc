// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/live_pose.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "src/draw/style.h"
#include "ui/window/strokes.h"

namespace poselift {
namespace {

constexpr double kTurn_rad = 0.009;  // a pixel of the mouse
constexpr int kSmallest = 160, kLargest = 1000;

}  // namespace

LivePoseCanvas::LivePoseCanvas(QWidget* parent) : QWidget(parent) {
  setObjectName("live_pose");
  setAccessibleName(tr("3D pose"));
  setToolTip(tr("Drag to turn, wheel to zoom, double click for the camera's view"));
  setMinimumSize(kSmallest, kSmallest);
}

void LivePoseCanvas::Show(const std::optional<LivePose>& pose, const QString& message) {
  pose_ = pose;
  message_ = message;
  update();
}

void LivePoseCanvas::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), ColorFrom(palette::kPaper));
  if (!pose_) {
    painter.setPen(Qt::black);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, message_);
    return;
  }
  const double ratio = devicePixelRatioF();
  const int side_px =
      std::clamp(static_cast<int>(ratio * std::min(width(), height())), kSmallest, kLargest);
  const cv::Mat panel = DrawPoseFrom(
      {.joints_in_cam_m = pose_->joints_in_cam_m, .up_in_cam = pose_->up_in_cam}, orbit_, side_px);
  const QImage image(panel.data, panel.cols, panel.rows, static_cast<int>(panel.step),
                     QImage::Format_BGR888);
  const double side = std::min(width(), height());
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(QRectF((width() - side) / 2.0, (height() - side) / 2.0, side, side), image);
}

void LivePoseCanvas::mousePressEvent(QMouseEvent* event) { dragged_from_ = event->position(); }

void LivePoseCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton) return;
  const QPointF by = event->position() - dragged_from_;
  dragged_from_ = event->position();
  orbit_.yaw_rad = std::remainder(orbit_.yaw_rad - kTurn_rad * by.x(), 2.0 * M_PI);
  orbit_.pitch_rad = std::clamp(orbit_.pitch_rad + kTurn_rad * by.y(), -0.4, M_PI / 2.0 - 0.01);
  update();
}

void LivePoseCanvas::mouseDoubleClickEvent(QMouseEvent* /*event*/) {
  orbit_ = {.yaw_rad = 0.0, .pitch_rad = 0.0};
  update();
}

void LivePoseCanvas::wheelEvent(QWheelEvent* event) {
  orbit_.zoom = std::clamp(orbit_.zoom * std::pow(2.0, event->angleDelta().y() / 480.0), 0.2, 20.0);
  update();
}

}  // namespace poselift
