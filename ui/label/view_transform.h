// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

namespace poselift {

// Where a picture is seen in a widget:
//
//   x_in_widget = scale (x_px + 1/2) + offset_in_widget
//
// mirrored, with -scale along x.
//
// x_px: pixels of the picture, integers are pixel centres. x_in_widget: from the widget's upper
// left corner, in the units of mouse events. One belongs to a view, not to a picture: the next
// picture is seen as this one is.
class ViewTransform {
 public:
  static constexpr double kLeastScale = 0.005, kLargestScale = 200.0;

  Eigen::Vector2d ToWidget(const Eigen::Vector2d& x_px) const {
    return Scales().cwiseProduct((x_px.array() + 0.5).matrix()) + offset_in_widget_;
  }
  Eigen::Vector2d ToPicture(const Eigen::Vector2d& x_in_widget) const {
    return (x_in_widget - offset_in_widget_).cwiseQuotient(Scales()).array() - 0.5;
  }
  double scale() const { return scale_; }
  const Eigen::Vector2d& offset_in_widget() const { return offset_in_widget_; }
  bool is_mirrored() const { return is_mirrored_; }

  // What is at x_in_widget stays there. The scale stays within its limits.
  void ZoomAt(const Eigen::Vector2d& x_in_widget, double factor) {
    SetScaleAt(x_in_widget, scale_ * factor);
  }
  void SetScaleAt(const Eigen::Vector2d& x_in_widget, double scale);
  void Pan(const Eigen::Vector2d& by_in_widget) { offset_in_widget_ += by_in_widget; }

  // Left and right change sides about the middle of a widget.
  void Mirror(double widget_width) {
    is_mirrored_ = !is_mirrored_;
    offset_in_widget_.x() = widget_width - offset_in_widget_.x();
  }

  // The whole picture (width, height), as large as it goes, in the middle; sizes of 0 change
  // nothing.
  void Fit(const Eigen::Vector2d& picture_size_px, const Eigen::Vector2d& widget_size);
  // A rectangle of the picture by two of its corners, likewise.
  void FitBox(const Eigen::Vector2d& a_px, const Eigen::Vector2d& b_px,
              const Eigen::Vector2d& widget_size);

 private:
  Eigen::Vector2d Scales() const { return {is_mirrored_ ? -scale_ : scale_, scale_}; }

  double scale_ = 1.0;
  bool is_mirrored_ = false;
  Eigen::Vector2d offset_in_widget_ = Eigen::Vector2d::Zero();
};

}  // namespace poselift
