// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/view_transform.h"

#include <algorithm>

namespace poselift {

void ViewTransform::SetScaleAt(const Eigen::Vector2d& x_in_widget, double scale) {
  const double before = scale_;
  scale_ = std::clamp(scale, kLeastScale, kLargestScale);
  offset_in_widget_ = x_in_widget + scale_ / before * (offset_in_widget_ - x_in_widget);
}

void ViewTransform::Fit(const Eigen::Vector2d& picture_size_px,
                        const Eigen::Vector2d& widget_size) {
  const Eigen::Vector2d first = Eigen::Vector2d::Constant(-0.5);
  FitBox(first, first + picture_size_px, widget_size);
}

void ViewTransform::FitBox(const Eigen::Vector2d& a_px, const Eigen::Vector2d& b_px,
                           const Eigen::Vector2d& widget_size) {
  const Eigen::Vector2d size_px = (b_px - a_px).cwiseAbs();
  if (!(size_px.minCoeff() > 0.0) || !(widget_size.minCoeff() > 0.0)) return;
  scale_ = std::clamp(widget_size.cwiseQuotient(size_px).minCoeff(), kLeastScale, kLargestScale);
  const Eigen::Vector2d middle_px = 0.5 * (a_px + b_px);
  offset_in_widget_ = 0.5 * widget_size - Scales().cwiseProduct((middle_px.array() + 0.5).matrix());
}

}  // namespace poselift
