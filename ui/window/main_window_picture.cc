// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The picture of the frame at hand: read in a thread of its own, for a frame of a long video may
// take a while.
#include <QSignalBlocker>
#include <QSlider>
#include <QStatusBar>
#include <chrono>
#include <cmath>
#include <exception>

#include "ui/window/image_from.h"
#include "ui/window/main_window.h"
#include "ui/window/picture_canvas.h"

namespace poselift {

void MainWindow::ShowPicture() {
  if (session_.labels().frames.empty()) return;
  const QSignalBlocker blocker(frames_);
  frames_->setRange(0, static_cast<int>(session_.labels().frames.size()) - 1);
  frames_->setValue(static_cast<int>(session_.frame_index()));
  if (shown_frame_ == session_.frame_index()) return;
  shown_frame_ = session_.frame_index();
  const FrameLabels& at_hand = session_.labels().frames[*shown_frame_];
  const bool was_reading = reading_.IsBusy();
  reading_.Start(
      [this, frame = FrameLabels{.image = at_hand.image, .frame = at_hand.frame}](
          const ProgressFn& progress) { return ImageFrom(pictures_.Read(frame, progress)); });
  // Most are there at once and follow each other without a flicker. Who is already ahead of the
  // pictures is not held up.
  constexpr std::chrono::milliseconds kAtOnce(100);
  if (!was_reading) reading_.WaitAtMost(kAtOnce);
  // Not the picture before: whose joints would be clicked?
  if (reading_.IsBusy()) picture_->SetPicture(Ground());
  TakePicture();
}

QImage MainWindow::Ground() const {
  const FrameLabels& frame = session_.labels().frames[session_.frame_index()];
  return EmptyPicture({frame.width_px, frame.height_px});
}

void MainWindow::TakePicture() {
  try {
    if (const auto picture = reading_.Take())
      picture_->SetPicture(picture->isNull() ? Ground() : *picture);
  } catch (const std::exception& error) {
    picture_->SetPicture(Ground());
    statusBar()->showMessage(error.what() + tr("; File, Find moved pictures says where it is now"));
  }
  SayReading();
}

void MainWindow::SayReading() {
  picture_->SetNote(
      reading_.IsBusy()
          ? tr("reading the picture: %1 %").arg(std::lround(100.0 * reading_.Fraction()))
          : QString());
}

void MainWindow::WaitForPicture() {
  reading_.WaitUntilIdle();
  TakePicture();
}

}  // namespace poselift
