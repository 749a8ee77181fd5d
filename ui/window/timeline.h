// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QWidget>

#include "ui/label/label_session.h"

namespace poselift {

// All frames side by side: which of them have labels, of the person at hand all (solid) or some
// (faint), placed by a person (a key frame: full height) or followed (low), and which one is
// shown. A click goes to a frame.
class Timeline : public QWidget {
  Q_OBJECT

 public:
  explicit Timeline(LabelSession* session, QWidget* parent = nullptr);

 signals:
  void Chosen(int frame);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  void PaintMotion(QPainter* painter, double step) const;
  void Choose(double x);

  LabelSession* session_;
};

}  // namespace poselift
