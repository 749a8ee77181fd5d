// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/live_canvas.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <cmath>
#include <utility>

#include "src/draw/style.h"
#include "src/joints.h"
#include "ui/window/image_from.h"
#include "ui/window/strokes.h"

namespace poselift {

LiveCanvas::LiveCanvas(QWidget* parent) : QWidget(parent) {
  setObjectName("live_picture");
  setAccessibleName(tr("The camera's picture, with tags and skeleton"));
  setMinimumSize(200, 150);
}

void LiveCanvas::Show(LiveView view) {
  if (view.number != view_.number) image_ = ImageFrom(view.bgr);
  view_ = std::move(view);
  update();
}

QPointF LiveCanvas::ToWidget(const Eigen::Vector2d& x_px) const {
  const Eigen::Vector2d x = transform_.ToWidget(x_px);
  return {x.x(), x.y()};
}

void LiveCanvas::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Dark));
  if (image_.isNull()) return;
  if (is_fitted_)
    transform_.Fit(Eigen::Vector2d(image_.width(), image_.height()),
                   Eigen::Vector2d(width(), height()));
  const QRectF target(ToWidget(Eigen::Vector2d(-0.5, -0.5)),
                      QSizeF(image_.size()) * transform_.scale());
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  painter.drawImage(target, image_);
  PaintTags(&painter);
  PaintPose(&painter);
}

void LiveCanvas::wheelEvent(QWheelEvent* event) {
  constexpr double kOctave = 480.0;  // four clicks
  transform_.ZoomAt({event->position().x(), event->position().y()},
                    std::pow(2.0, event->angleDelta().y() / kOctave));
  is_fitted_ = false;
  update();
}

void LiveCanvas::mousePressEvent(QMouseEvent* event) { panned_from_ = event->position(); }

void LiveCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (is_fitted_ || !(event->buttons() & Qt::LeftButton)) return;
  const QPointF by = event->position() - panned_from_;
  panned_from_ = event->position();
  transform_.Pan({by.x(), by.y()});
  update();
}

void LiveCanvas::mouseDoubleClickEvent(QMouseEvent* /*event*/) {
  is_fitted_ = true;
  update();
}

// The upper edge, as it is printed, is thicker.
void LiveCanvas::PaintTags(QPainter* painter) const {
  const QColor color = ColorFrom(palette::kError);
  for (const TagDetection& tag : view_.tags) {
    QPainterPath outline(ToWidget(tag.corners_px.col(0)));
    for (int corner = 1; corner < 4; ++corner) outline.lineTo(ToWidget(tag.corners_px.col(corner)));
    outline.closeSubpath();
    StrokeTwice(painter, outline, color, 1.5);
    QPainterPath upper(ToWidget(tag.corners_px.col(0)));
    upper.lineTo(ToWidget(tag.corners_px.col(1)));
    StrokeTwice(painter, upper, color, 3.0);
  }
}

void LiveCanvas::PaintPose(QPainter* painter) const {
  if (!view_.pose) return;
  const Eigen::Matrix2Xd joints_px = view_.pose->JointsInPicture_px();
  painter->setOpacity(0.75);
  for (int j = 1; j < kNumJoints; ++j) {
    const int before = Joints()[static_cast<size_t>(j)].parent;
    if (!joints_px.col(j).allFinite() || !joints_px.col(before).allFinite()) continue;
    QPainterPath bone(ToWidget(joints_px.col(before)));
    bone.lineTo(ToWidget(joints_px.col(j)));
    const bool is_seen = view_.pose->is_seen[static_cast<size_t>(j)] &&
                         view_.pose->is_seen[static_cast<size_t>(before)];
    StrokeTwice(painter, bone, ColorFrom(ColorOf(SideOf(j))), 4.0,
                is_seen ? Qt::SolidLine : Qt::DotLine);
  }
  painter->setOpacity(1.0);
}

}  // namespace poselift
