// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QPointF>
#include <optional>

#include "src/draw/pose_view.h"
#include "ui/label/label_session.h"
#include "ui/window/orbit_canvas.h"

class QPainter;

namespace poselift {

// The pose at hand in space, on its floor, with the other poses that fit as ghosts; or that of the
// motion, where it is shown. A joint that is pressed is dragged, in the plane of the view through
// it; with Shift its limb follows alone, the right button pins it. Dragging elsewhere turns the
// pose, the wheel zooms, a double click looks from where the camera is.
class PoseCanvas : public OrbitCanvas {
  Q_OBJECT

 public:
  explicit PoseCanvas(LabelSession* session, QWidget* parent = nullptr);

  QSize sizeHint() const override { return {460, 460}; }
  // Where a handle of the session's pose is in the widget; nothing without a pose.
  std::optional<QPointF> HandleAt(size_t handle) const;

 signals:
  void Changed();  // labels or what is at hand

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  struct Drag {
    size_t handle = 0;
    QPointF pressed;
    Eigen::Vector2d grab_px;  // from the mouse to the joint
    Eigen::Vector3d from_in_cam_m, by_m = Eigen::Vector3d::Zero();
    Scene stage;  // the view stands still
    bool is_moved = false;
  };
  // Of a frame by itself; a motion is only looked at.
  bool HasHandles() const {
    return session_->pose() && !session_->ShowsMotion() && !session_->IsBetween();
  }
  PoseViewInput Input() const;
  Scene Stage() const;
  std::optional<size_t> Hit(const QPointF& x_in_widget) const;
  void MoveTo(const QPointF& x_in_widget);
  void PaintHandles(QPainter* painter) const;
  QString Kind() const;

  LabelSession* session_;
  std::optional<Drag> drag_;
};

}  // namespace poselift
