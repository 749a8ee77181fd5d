// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/pose_canvas.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "src/draw/style.h"

namespace poselift {
namespace {

constexpr double kTurn_rad = 0.009;  // a pixel of the mouse
constexpr double kStep_rad = 0.15;   // a key
constexpr int kSmallest = 160, kLargest = 2000;

}  // namespace

PoseCanvas::PoseCanvas(LabelSession* session, QWidget* parent)
    : QWidget(parent), session_(session) {
  setObjectName("pose");
  setAccessibleName(tr("3D pose"));
  setToolTip(tr("Drag to turn, wheel to zoom, double click for the camera's view"));
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(kSmallest, kSmallest);
}

void PoseCanvas::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const cv::Scalar& paper = palette::kPaper;
  painter.fillRect(rect(), QColor(static_cast<int>(paper[2]), static_cast<int>(paper[1]),
                                  static_cast<int>(paper[0])));
  const LiftedPose* pose = session_->ShownPose();
  if (!pose) {
    painter.setPen(Qt::black);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     QString::fromStdString(session_->result().message));
    return;
  }
  PoseViewInput input{.joints_in_cam_m = pose->joints_in_cam_m};
  const bool is_motion = session_->ShowsMotion();
  for (size_t i = 0; i < session_->result().poses.size(); ++i)
    if (!is_motion && i != session_->pose_index())
      input.alternatives_in_cam_m.push_back(session_->result().poses[i].joints_in_cam_m);
  const double ratio = devicePixelRatioF();
  const int side_px =
      std::clamp(static_cast<int>(ratio * std::min(width(), height())), kSmallest, kLargest);
  const cv::Mat panel = DrawPoseFrom(input, orbit_, side_px);
  const QImage image(panel.data, panel.cols, panel.rows, static_cast<int>(panel.step),
                     QImage::Format_BGR888);
  const double side = side_px / ratio;
  painter.drawImage(QRectF((width() - side) / 2.0, (height() - side) / 2.0, side, side), image);
  painter.setPen(Qt::black);
  painter.drawText(rect().adjusted(8, 6, -8, -6), Qt::AlignTop | Qt::AlignLeft, Kind());
}

// Which pose it is, once there are two kinds.
QString PoseCanvas::Kind() const {
  const PersonMotion* const motion = session_->motion();
  if (!motion || !motion->HasPoses()) return {};
  if (!session_->ShowsMotion()) return tr("this picture alone");
  QString kind = tr("smoothed motion");
  if (motion->is_filled[session_->frame_index()]) kind += tr(", filled for want of labels");
  return session_->IsMotionCurrent() ? kind : kind + tr(", out of date");
}

void PoseCanvas::Turn(double yaw_rad, double pitch_rad) {
  orbit_.yaw_rad = std::remainder(orbit_.yaw_rad + yaw_rad, 2.0 * M_PI);
  orbit_.pitch_rad = std::clamp(orbit_.pitch_rad + pitch_rad, -0.4, M_PI / 2.0 - 0.01);
  update();
}

void PoseCanvas::mousePressEvent(QMouseEvent* event) { dragged_from_ = event->position(); }

void PoseCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton) return;
  const QPointF by = event->position() - dragged_from_;
  dragged_from_ = event->position();
  Turn(-kTurn_rad * by.x(), kTurn_rad * by.y());
}

void PoseCanvas::mouseDoubleClickEvent(QMouseEvent* /*event*/) {
  orbit_ = {.yaw_rad = 0.0, .pitch_rad = 0.0};
  update();
}

void PoseCanvas::wheelEvent(QWheelEvent* event) {
  orbit_.zoom = std::clamp(orbit_.zoom * std::pow(2.0, event->angleDelta().y() / 480.0), 0.2, 20.0);
  update();
}

void PoseCanvas::keyPressEvent(QKeyEvent* event) {
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
