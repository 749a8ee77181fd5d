// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QString>
#include <optional>

#include "ui/live/live_view.h"
#include "ui/window/orbit_canvas.h"

namespace poselift {

// The pose of who is tracked, in space.
class LivePoseCanvas : public OrbitCanvas {
  Q_OBJECT

 public:
  explicit LivePoseCanvas(QWidget* parent = nullptr);

  // message: what is said where there is no pose.
  void Show(const std::optional<LivePose>& pose, const QString& message);
  bool has_pose() const { return pose_.has_value(); }
  QSize sizeHint() const override { return {440, 440}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::optional<LivePose> pose_;
  QString message_;
};

}  // namespace poselift
