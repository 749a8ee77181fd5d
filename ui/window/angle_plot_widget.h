// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QPixmap>
#include <QWidget>
#include <cstdint>
#include <vector>

#include "src/draw/plot_axis.h"
#include "ui/label/label_session.h"

namespace poselift {

// Angles of the session's motion over time, with a band of one standard deviation, fainter where
// frames were filled; a cursor at the frame at hand and what the angles are there. A click or a
// drag goes to a frame.
class AnglePlotWidget : public QWidget {
  Q_OBJECT

 public:
  explicit AnglePlotWidget(LabelSession* session, QWidget* parent = nullptr);

  void SetAngles(const std::vector<int>& angles);  // of JointAngles()
  QSize sizeHint() const override { return {720, 190}; }

 signals:
  void Chosen(int frame);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  QRectF Area() const;
  double X(double time_s) const;
  double Y(double angle_deg) const;
  void Measure(const PersonMotion& motion);
  void PaintAll();
  void PaintAxes(QPainter* painter) const;
  void PaintFilled(QPainter* painter, const PersonMotion& motion) const;
  void PaintCurve(QPainter* painter, const PersonMotion& motion, int angle,
                  const QColor& color) const;
  void PaintLegend(QPainter* painter, const PersonMotion& motion, Eigen::Index frame) const;
  void Choose(double x);

  LabelSession* session_;
  std::vector<int> angles_;
  PlotRange times_s_, angles_deg_;
  QPixmap curves_;                    // all but cursor and legend, which move often
  std::uint64_t painted_number_ = 0;  // of the motion
  bool painted_as_current_ = false;
};

}  // namespace poselift
