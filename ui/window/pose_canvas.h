// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QPointF>
#include <QWidget>
#include <optional>

#include "src/draw/pose_view.h"
#include "ui/label/label_session.h"

namespace poselift {

// The pose at hand in space, on its floor, with the other poses that fit as ghosts; or that of the
// motion, where it is shown. Dragging
// turns it, the wheel zooms, a double click looks from where the camera is.
class PoseCanvas : public QWidget {
  Q_OBJECT

 public:
  explicit PoseCanvas(LabelSession* session, QWidget* parent = nullptr);

  const PoseOrbit& orbit() const { return orbit_; }
  QSize sizeHint() const override { return {460, 460}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QString Kind() const;
  void Turn(double yaw_rad, double pitch_rad);

  LabelSession* session_;
  PoseOrbit orbit_;
  QPointF dragged_from_;
};

}  // namespace poselift
