// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The motion of the person at hand: its dock, playing it, writing it.
#include <QFileDialog>
#include <QSlider>
#include <QStatusBar>

#include "lift/lifted_files.h"
#include "ui/window/main_window.h"
#include "ui/window/motion_dock.h"
#include "ui/window/player.h"

namespace poselift {
namespace {

QString TextOf(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}

}  // namespace

// Hidden until somebody asks for a motion: before, there is more to see in the picture.
void MainWindow::AddMotion() {
  motion_ = new MotionDock(&session_, keys_, this);
  addDockWidget(Qt::BottomDockWidgetArea, motion_);
  splitDockWidget(findChild<QDockWidget*>("frames_dock"), motion_, Qt::Vertical);
  docks_.push_back(motion_);
  motion_->hide();
  connect(motion_, &MotionDock::Asked, this, [this] { Do(Action::kSmoothMotion); });
  connect(motion_, &MotionDock::Changed, this, &MainWindow::Refresh);
  connect(motion_, &MotionDock::Chosen, frames_, &QSlider::setValue);
  player_ = new Player(&session_, this);
  connect(player_, &Player::FrameDue, this, [this](int frame) {
    session_.PlayTo(static_cast<size_t>(frame));
    Refresh();
  });
  connect(player_, &Player::Stopped, this, [this] {
    session_.GoToFrame(session_.frame_index());
    Refresh();
  });
}

void MainWindow::AskExportMotion() {
  QStringList filters;
  for (const LiftedFormat& format : LiftedFormats())
    filters << QString("%1 (*%2)").arg(tr(format.name.data()), TextOf(format.ending));
  QString chosen = filters.front();
  QString file = QFileDialog::getSaveFileName(this, tr("Export the motion"), "motion",
                                              filters.join(";;"), &chosen);
  if (file.isEmpty()) return;
  const qsizetype index = filters.indexOf(chosen);
  if (QFileInfo(file).suffix().isEmpty() && index >= 0)
    file += TextOf(LiftedFormats()[static_cast<size_t>(index)].ending);
  ExportMotionTo(file);
}

void MainWindow::ExportMotionTo(const QString& file) {
  if (Try([&] { session_.ExportMotion(file.toStdString()); }))
    statusBar()->showMessage(tr("exported to %1").arg(file), 5000);
}

}  // namespace poselift
