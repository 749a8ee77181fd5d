// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/live_pose.h"

#include <QPainter>

namespace poselift {

LivePoseCanvas::LivePoseCanvas(QWidget* parent) : OrbitCanvas(parent) {
  setObjectName("live_pose");
}

void LivePoseCanvas::Show(const std::optional<LivePose>& pose, const QString& message) {
  pose_ = pose;
  message_ = message;
  update();
}

void LivePoseCanvas::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  if (!pose_) return PaintMessage(&painter, message_);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  PaintPanel(&painter, DrawPoseFrom({.joints_in_cam_m = pose_->joints_in_cam_m,
                                     .up_in_cam = pose_->up_in_cam},
                                    orbit(), Side_px()));
}

}  // namespace poselift
