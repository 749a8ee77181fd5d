// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QPointF>
#include <QWidget>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "src/draw/pose_view.h"

namespace poselift {

// A view in space, drawn as a square in the middle. Dragging and the arrow keys turn it, the wheel
// zooms, a double click looks from where the camera is.
class OrbitCanvas : public QWidget {
  Q_OBJECT

 public:
  explicit OrbitCanvas(QWidget* parent);

  const PoseOrbit& orbit() const { return orbit_; }

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

  // The square, in pixels of the screen.
  int Side_px() const;
  Eigen::Vector2d ToPanel(const QPointF& x_in_widget) const;
  QPointF ToWidget(const Eigen::Vector2d& x_px) const;
  // Side_px large, on paper.
  void PaintPanel(QPainter* painter, const cv::Mat& panel) const;
  // Where there is nothing to see.
  void PaintMessage(QPainter* painter, const QString& message) const;

 private:
  void Turn(double yaw_rad, double pitch_rad);

  PoseOrbit orbit_;
  std::optional<QPointF> turned_from_;
};

}  // namespace poselift
