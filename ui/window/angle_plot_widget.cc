// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/angle_plot_widget.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>
#include <cmath>

#include "lift/frame_span.h"
#include "src/draw/style.h"
#include "src/joint_angles.h"

namespace poselift {
namespace {

constexpr double kLeft = 52.0, kLegend = 270.0, kTop = 8.0, kBottom = 22.0, kSample = 16.0;
constexpr double kLeast_deg = 10.0, kFaint = 0.3;

QColor Grey(const cv::Scalar& bgr) {
  return {static_cast<int>(bgr[2]), static_cast<int>(bgr[1]), static_cast<int>(bgr[0])};
}

}  // namespace

AnglePlotWidget::AnglePlotWidget(LabelSession* session, QWidget* parent)
    : QWidget(parent), session_(session) {
  setObjectName("angle_plot");
  setAccessibleName(tr("Angles of the motion over time"));
  setToolTip(tr("Angles of the motion, with one standard deviation; a click goes to the picture"));
  setMinimumSize(380, 110);
}

void AnglePlotWidget::SetAngles(const std::vector<int>& angles) {
  angles_ = angles;
  curves_ = {};
  update();
}

QRectF AnglePlotWidget::Area() const {
  return {kLeft, kTop, width() - kLeft - kLegend, height() - kTop - kBottom};
}

double AnglePlotWidget::X(double time_s) const {
  return Area().left() + Area().width() * (time_s - times_s_.low) / (times_s_.high - times_s_.low);
}

double AnglePlotWidget::Y(double angle_deg) const {
  return Area().bottom() -
         Area().height() * (angle_deg - angles_deg_.low) / (angles_deg_.high - angles_deg_.low);
}

void AnglePlotWidget::Measure(const PersonMotion& motion) {
  times_s_ = angles_deg_ = {};
  for (Eigen::Index f = 0; f < motion.times_s.size(); ++f) {
    if (!motion.PoseOf(static_cast<size_t>(f))) continue;
    times_s_.Add(motion.times_s[f]);
    for (const int a : angles_) {
      const double sigma_deg = motion.angles_sigma_deg(a, f);
      const double band_deg = std::isfinite(sigma_deg) ? sigma_deg : 0.0;
      angles_deg_.Add(motion.angles_deg(a, f) - band_deg);
      angles_deg_.Add(motion.angles_deg(a, f) + band_deg);
    }
  }
  if (angles_deg_.IsEmpty()) angles_deg_ = {0.0, 0.0};
  angles_deg_ = angles_deg_.Widened(0.04, kLeast_deg);
  times_s_ = times_s_.Widened(0.0, 1e-3);
}

void AnglePlotWidget::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), Grey(palette::kPaper));
  const PersonMotion* const motion = session_->motion();
  if (!motion || !motion->HasPoses()) {
    painter.setPen(Qt::black);
    painter.drawText(rect().adjusted(8, 8, -8, -8), Qt::AlignCenter | Qt::TextWordWrap,
                     motion ? QString::fromStdString(motion->message)
                     : session_->HasKeyFrames()
                         ? tr("No motion yet: two key frames make one, and its angles are here")
                         : tr("No motion yet: smoothing lifts all pictures of the person "
                              "together, and shows their angles here"));
    return;
  }
  if (curves_.size() != size() * devicePixelRatioF() || painted_number_ != motion->number ||
      painted_as_current_ != session_->IsMotionCurrent())
    PaintAll();
  painter.drawPixmap(0, 0, curves_);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto frame = static_cast<Eigen::Index>(session_->MotionFrame());
  PaintLegend(&painter, *motion, frame);
  if (frame >= motion->times_s.size()) return;
  const double x = X(motion->times_s[frame]);
  if (!(x >= Area().left() - 1.0 && x <= Area().right() + 1.0)) return;
  painter.setPen(QPen(Qt::black, 1.0));
  painter.drawLine(QPointF(x, Area().top()), QPointF(x, Area().bottom()));
  for (size_t i = 0; i < angles_.size(); ++i) {
    const double angle_deg = motion->angles_deg(angles_[i], frame);
    if (!std::isfinite(angle_deg)) continue;
    painter.setBrush(QColor(CurveColor(static_cast<int>(i))));
    painter.drawEllipse(QPointF(x, Y(angle_deg)), 3.5, 3.5);
  }
}

void AnglePlotWidget::PaintAll() {
  const PersonMotion& motion = *session_->motion();
  Measure(motion);
  painted_number_ = motion.number;
  painted_as_current_ = session_->IsMotionCurrent();
  curves_ = QPixmap(size() * devicePixelRatioF());
  curves_.setDevicePixelRatio(devicePixelRatioF());
  curves_.fill(Grey(palette::kPaper));
  QPainter painter(&curves_);
  painter.setFont(font());
  painter.setRenderHint(QPainter::Antialiasing);
  PaintFilled(&painter, motion);
  PaintAxes(&painter);
  painter.setClipRect(Area());
  for (size_t i = 0; i < angles_.size(); ++i)
    PaintCurve(&painter, motion, angles_[i], QColor(CurveColor(static_cast<int>(i))));
  if (painted_as_current_) return;
  painter.setPen(QColor(CurveColor(1)));
  painter.drawText(Area().adjusted(6, 4, -6, -4), Qt::AlignTop | Qt::AlignLeft,
                   tr("out of date: labels have changed"));
}

void AnglePlotWidget::PaintAxes(QPainter* painter) const {
  const QRectF area = Area();
  const QColor line = Grey(palette::kGrid), ink = Grey(palette::kInk);
  const double step_s = TickStep(times_s_, area.width() / 90.0);
  for (double n = std::ceil(times_s_.low / step_s); n * step_s <= times_s_.high; ++n) {
    const double x = X(n * step_s);
    painter->setPen(line);
    painter->drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    painter->setPen(ink);
    painter->drawText(QRectF(x - 40.0, area.bottom() + 2.0, 80.0, kBottom), Qt::AlignHCenter,
                      QString::fromStdString(TickText(n * step_s, step_s)) + tr(" s"));
  }
  const double step_deg = TickStep(angles_deg_, area.height() / 34.0);
  for (double n = std::ceil(angles_deg_.low / step_deg); n * step_deg <= angles_deg_.high; ++n) {
    const double y = Y(n * step_deg);
    painter->setPen(line);
    painter->drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
    painter->setPen(ink);
    painter->drawText(QRectF(0.0, y - 10.0, kLeft - 5.0, 20.0), Qt::AlignRight | Qt::AlignVCenter,
                      QString::fromStdString(TickText(n * step_deg, step_deg)) + tr("°"));
  }
}

void AnglePlotWidget::PaintFilled(QPainter* painter, const PersonMotion& motion) const {
  for (const FrameSpan& span : SpansOf(motion.is_filled)) {
    const double from = X(motion.times_s[span.first]), to = X(motion.times_s[span.last]);
    painter->fillRect(QRectF(from - 1.0, Area().top(), to - from + 2.0, Area().height()),
                      Grey(palette::kFar));
  }
}

// In pieces, where it stops and starts again and where it becomes fainter.
void AnglePlotWidget::PaintCurve(QPainter* painter, const PersonMotion& motion, int angle,
                                 const QColor& color) const {
  QPolygonF line, upper, lower;
  const auto end_piece = [&](bool is_filled) {
    QColor band = color, pen = color;
    band.setAlphaF(is_filled ? 0.08F : 0.18F);
    pen.setAlphaF(is_filled || !painted_as_current_ ? kFaint : 1.0);
    for (auto point = lower.crbegin(); point != lower.crend(); ++point) upper << *point;
    painter->setPen(Qt::NoPen);
    painter->setBrush(band);
    painter->drawPolygon(upper);
    painter->setPen(QPen(pen, 1.6));
    painter->drawPolyline(line);
    line.clear(), upper.clear(), lower.clear();
  };
  bool was_filled = false;  // the step to the frame before, or that frame
  for (Eigen::Index f = 0; f < motion.times_s.size(); ++f) {
    const double angle_deg = motion.angles_deg(angle, f);
    if (!std::isfinite(angle_deg)) {
      if (!line.isEmpty()) end_piece(was_filled);
      continue;
    }
    const auto add = [&](Eigen::Index g) {
      const double x = X(motion.times_s[g]), sigma_deg = motion.angles_sigma_deg(angle, g);
      line << QPointF(x, Y(motion.angles_deg(angle, g)));
      if (!std::isfinite(sigma_deg)) return;
      upper << QPointF(x, Y(motion.angles_deg(angle, g) + sigma_deg));
      lower << QPointF(x, Y(motion.angles_deg(angle, g) - sigma_deg));
    };
    const bool is_filled = motion.is_filled[static_cast<size_t>(f)];
    if (!line.isEmpty() && is_filled != was_filled) {
      // Both steps at the ends of a gap are as faint as the gap.
      if (was_filled) add(f);
      end_piece(was_filled);
      if (is_filled) add(f - 1);
    }
    add(f);
    was_filled = is_filled;
  }
  if (!line.isEmpty()) end_piece(was_filled);
}

// What the angles are at the cursor.
void AnglePlotWidget::PaintLegend(QPainter* painter, const PersonMotion& motion,
                                  Eigen::Index frame) const {
  const double row = fontMetrics().height() + 2.0, left = width() - kLegend + 12.0;
  for (size_t i = 0; i < angles_.size(); ++i) {
    const double top = kTop + static_cast<double>(i) * row;
    painter->fillRect(QRectF(left, top + row / 2.0 - 2.0, kSample, 4.0),
                      QColor(CurveColor(static_cast<int>(i))));
    QString text = QString::fromStdString(JointAngles()[static_cast<size_t>(angles_[i])].name);
    if (frame < motion.angles_deg.cols() && std::isfinite(motion.angles_deg(angles_[i], frame))) {
      text += tr(": %1°").arg(motion.angles_deg(angles_[i], frame), 0, 'f', 1);
      const double sigma_deg = motion.angles_sigma_deg(angles_[i], frame);
      if (std::isfinite(sigma_deg)) text += tr(" ± %1°").arg(sigma_deg, 0, 'f', 1);
    }
    painter->setPen(Grey(palette::kInk));
    painter->drawText(QRectF(left + kSample + 6.0, top, kLegend - kSample - 18.0, row),
                      Qt::AlignLeft | Qt::AlignVCenter, text);
  }
}

// The frame of the motion whose time is nearest.
void AnglePlotWidget::Choose(double x) {
  const PersonMotion* const motion = session_->motion();
  if (!motion || !motion->HasPoses() || times_s_.IsEmpty()) return;
  Eigen::Index nearest = -1;
  for (Eigen::Index f = 0; f < motion->times_s.size(); ++f) {
    if (!motion->PoseOf(static_cast<size_t>(f))) continue;
    if (nearest < 0 ||
        std::abs(X(motion->times_s[f]) - x) < std::abs(X(motion->times_s[nearest]) - x))
      nearest = f;
  }
  if (nearest >= 0) emit Chosen(static_cast<int>(nearest));
}

void AnglePlotWidget::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) Choose(event->position().x());
}

void AnglePlotWidget::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) Choose(event->position().x());
}

}  // namespace poselift
