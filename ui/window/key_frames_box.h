// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QWidget>

#include "ui/label/key_map.h"
#include "ui/label/label_session.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace poselift {

class KeyTimeline;

// The key frames of poses without pictures: their timeline, and below it the frame that the one at
// hand is on, the rate of frames, and what is done with key frames most.
class KeyFramesBox : public QWidget {
  Q_OBJECT

 public:
  KeyFramesBox(LabelSession* session, const KeyMap& keys, QWidget* parent);

  void Refresh();

 signals:
  void Asked(Action action);
  void Changed();  // labels or what is at hand

 private:
  QPushButton* MakeButton(const QString& text, Action action, const KeyMap& keys);

  LabelSession* session_;
  KeyTimeline* timeline_ = nullptr;
  QLabel *which_ = nullptr, *time_ = nullptr;
  QSpinBox* number_ = nullptr;
  QDoubleSpinBox* rate_ = nullptr;
};

}  // namespace poselift
