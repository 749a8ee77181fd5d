// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The motion of the person at hand: its dock, playing it.

#include "ui/window/main_window.h"
#include "ui/window/motion_dock.h"
#include "ui/window/player.h"

namespace poselift {

// Hidden until somebody asks for a motion: before, there is more to see in the picture.
void MainWindow::AddMotion() {
  motion_ = new MotionDock(&session_, keys_, this);
  addDockWidget(Qt::BottomDockWidgetArea, motion_);
  splitDockWidget(findChild<QDockWidget*>("frames_dock"), motion_, Qt::Vertical);
  docks_.push_back(motion_);
  motion_->hide();
  connect(motion_, &MotionDock::Asked, this, [this] { Do(Action::kSmoothMotion); });
  connect(motion_, &MotionDock::Changed, this, &MainWindow::Refresh);
  connect(motion_, &MotionDock::Chosen, this, [this](int frame) {
    session_.GoToMotionFrame(static_cast<size_t>(frame));
    Refresh();
  });
  player_ = new Player(
      &session_, [this] { return reading_.IsBusy(); }, this);
  connect(player_, &Player::FrameDue, this, [this](int frame) {
    session_.PlayTo(static_cast<size_t>(frame));
    Refresh();
  });
  connect(player_, &Player::Stopped, this, [this] {
    session_.GoToMotionFrame(session_.MotionFrame());
    Refresh();
  });
}

}  // namespace poselift
