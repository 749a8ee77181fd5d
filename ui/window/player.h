// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <functional>
#include <optional>

#include "ui/label/label_session.h"
#include "ui/label/playback.h"

namespace poselift {

// Plays the frames in real time from the one at hand to the last, where it stops; from the first
// when started at the last. Frames that cannot be shown in time are left out: none is due while the
// one before is not there yet. Who goes to another frame meanwhile stops it.
class Player : public QObject {
  Q_OBJECT

 public:
  // is_late: whether the frame that was due last is still to come.
  Player(LabelSession* session, std::function<bool()> is_late, QObject* parent);

  void Toggle();
  bool is_playing() const { return playback_.has_value(); }

 signals:
  void FrameDue(int frame);  // of the motion
  void Stopped();

 private:
  void Tick();
  void Stop();

  LabelSession* session_;
  std::function<bool()> is_late_;
  std::optional<Playback> playback_;
  size_t shown_ = 0;
  QElapsedTimer clock_;
  QTimer timer_;
};

}  // namespace poselift
