// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <optional>

#include "ui/label/label_session.h"
#include "ui/label/playback.h"

namespace poselift {

// Plays the frames in real time from the one at hand to the last, where it stops; from the first
// when started at the last. Frames that cannot be shown in time are left out. Who goes to another
// frame meanwhile stops it.
class Player : public QObject {
  Q_OBJECT

 public:
  explicit Player(LabelSession* session, QObject* parent);

  void Toggle();
  bool is_playing() const { return playback_.has_value(); }

 signals:
  void FrameDue(int frame);
  void Stopped();

 private:
  void Tick();
  void Stop();

  LabelSession* session_;
  std::optional<Playback> playback_;
  size_t shown_ = 0;
  QElapsedTimer clock_;
  QTimer timer_;
};

}  // namespace poselift
