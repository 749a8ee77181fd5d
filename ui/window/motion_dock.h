// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QDockWidget>
#include <QTimer>

#include "ui/label/key_map.h"
#include "ui/label/label_session.h"

class QCheckBox;
class QLabel;
class QListWidget;
class QProgressBar;
class QPushButton;

namespace poselift {

class AnglePlotWidget;

// The motion of the person at hand: asks for it, says how far that is and what came of it, and
// plots the angles that are chosen.
class MotionDock : public QDockWidget {
  Q_OBJECT

 public:
  MotionDock(LabelSession* session, const KeyMap& keys, QWidget* parent);

  void Refresh();

 signals:
  void Asked();    // for the motion
  void Changed();  // what is shown
  void Chosen(int frame);

 private:
  QWidget* MakeControls(const KeyMap& keys);
  QString Text() const;
  void AskOrCancel();
  void ShowProgress();

  LabelSession* session_;
  QPushButton* ask_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QCheckBox* show_ = nullptr;
  QListWidget* angles_ = nullptr;
  QLabel* text_ = nullptr;
  AnglePlotWidget* plot_ = nullptr;
  QTimer timer_;  // while a motion is made
};

}  // namespace poselift
