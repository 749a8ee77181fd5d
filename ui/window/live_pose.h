// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QPointF>
#include <QString>
#include <QWidget>
#include <optional>

#include "src/draw/pose_view.h"
#include "ui/live/live_view.h"

namespace poselift {

// The pose of who is tracked, in space. Dragging turns it, the wheel zooms, a double click looks
// from where the camera is.
class LivePoseCanvas : public QWidget {
  Q_OBJECT

 public:
  explicit LivePoseCanvas(QWidget* parent = nullptr);

  // message: what is said where there is no pose.
  void Show(const std::optional<LivePose>& pose, const QString& message);
  bool has_pose() const { return pose_.has_value(); }
  QSize sizeHint() const override { return {440, 440}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  std::optional<LivePose> pose_;
  QString message_;
  PoseOrbit orbit_;
  QPointF dragged_from_;
};

}  // namespace poselift
