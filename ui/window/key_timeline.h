// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QWidget>
#include <optional>

#include "ui/label/label_session.h"

namespace poselift {

// Key frames in time, over a ruler of frames: a press on one goes to it and a drag moves it, with
// Shift all behind it too; elsewhere the mouse shows the motion.
class KeyTimeline : public QWidget {
  Q_OBJECT

 public:
  explicit KeyTimeline(LabelSession* session, QWidget* parent = nullptr);

  double X(int number) const;  // in the widget

 signals:
  void Changed();  // labels or what is at hand

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  struct Drag {
    size_t key = 0;
    double pressed_x = 0.0, last = 0.0;  // the ruler stands still
    std::optional<int> number = {};      // once it is moved
    Along along = Along::kAlone;
  };
  double LastNumber() const;
  int NumberAt(double x) const;
  std::optional<size_t> KeyAt(double x) const;
  KeyTimes ShownKeys() const;
  void PaintRuler(QPainter* painter) const;
  void PaintKeys(QPainter* painter) const;

  LabelSession* session_;
  std::optional<Drag> drag_;
};

}  // namespace poselift
