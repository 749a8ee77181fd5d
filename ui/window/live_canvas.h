// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QImage>
#include <QWidget>

#include "ui/label/view_transform.h"
#include "ui/live/live_view.h"

namespace poselift {

// The newest picture of a camera with the outlines of its tags and the skeleton of who wears them:
// bones dotted where no tag shows them. Whole, until the wheel zooms; the left button pans then,
// and twice gives the whole picture.
class LiveCanvas : public QWidget {
  Q_OBJECT

 public:
  explicit LiveCanvas(QWidget* parent = nullptr);

  void Show(LiveView view);
  const LiveView& view() const { return view_; }
  const ViewTransform& transform() const { return transform_; }
  QSize sizeHint() const override { return {760, 560}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  QPointF ToWidget(const Eigen::Vector2d& x_px) const;
  void PaintTags(QPainter* painter) const;
  void PaintPose(QPainter* painter) const;

  LiveView view_;
  QImage image_;
  ViewTransform transform_;
  bool is_fitted_ = true;
  QPointF panned_from_;
};

}  // namespace poselift
