// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/timeline.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

constexpr int kHeight = 20, kLine = 4;
constexpr double kSure_deg = 3.0, kUnsure_deg = 15.0;

}  // namespace

Timeline::Timeline(LabelSession* session, QWidget* parent) : QWidget(parent), session_(session) {
  setObjectName("timeline");
  setAccessibleName(tr("Which pictures have labels"));
  setToolTip(
      tr("Which pictures have labels, and below how sure the motion is of them: blue to %1°, red "
         "from %2°, lighter where labels are wanting; a click goes there")
          .arg(kSure_deg)
          .arg(kUnsure_deg));
  setFixedHeight(kHeight);
}

void Timeline::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  const auto& frames = session_->labels().frames;
  if (frames.empty()) return;
  const size_t count = session_->layout().landmarks.size();
  const double step = static_cast<double>(width()) / static_cast<double>(frames.size());
  const auto tick = [&](size_t f) {
    return QRectF(static_cast<double>(f) * step, 0.0, std::max(1.0, step - 1.0), kHeight - kLine);
  };
  QColor full = palette().color(QPalette::Highlight), part = full;
  part.setAlphaF(0.4F);
  for (size_t f = 0; f < frames.size(); ++f) {
    if (session_->person_index() >= frames[f].people.size()) continue;
    const PersonLabels& person = frames[f].people[session_->person_index()];
    const size_t num_labels = person.landmarks.size();
    QRectF mark = tick(f);
    if (person.is_propagated) mark.setTop(kHeight / 2.0);
    if (num_labels > 0) painter.fillRect(mark, num_labels < count ? part : full);
  }
  PaintMotion(&painter, step);
  painter.setPen(palette().color(QPalette::Text));
  painter.drawRect(tick(session_->frame_index()).adjusted(0.0, 0.0, 0.0, kLine - 1.0));
}

void Timeline::PaintMotion(QPainter* painter, double step) const {
  const PersonMotion* const motion = session_->motion();
  if (!motion || !motion->HasPoses()) return;
  const double faint = session_->IsMotionCurrent() ? 1.0 : 0.5;
  const auto a_pixel = static_cast<size_t>(std::max(1.0, std::floor(1.0 / step)));
  for (size_t f = 0; f < motion->is_filled.size(); f += a_pixel) {
    const double sigma_deg = motion->Sigma_deg(f);
    if (!std::isfinite(sigma_deg)) continue;
    const double doubt = std::clamp((sigma_deg - kSure_deg) / (kUnsure_deg - kSure_deg), 0.0, 1.0);
    constexpr double kBlue = 0.58;  // of the circle of hues; red is 0
    const QColor color =
        QColor::fromHsvF(static_cast<float>(kBlue * (1.0 - doubt)), 0.85F, 0.85F,
                         static_cast<float>(faint * (motion->is_filled[f] ? 0.4 : 1.0)));
    painter->fillRect(
        QRectF(static_cast<double>(f) * step, kHeight - kLine, std::max(1.0, step), kLine), color);
  }
}

void Timeline::Choose(double x) {
  const auto count = static_cast<double>(session_->labels().frames.size());
  if (count > 0.0)
    emit Chosen(static_cast<int>(std::clamp(std::floor(x / width() * count), 0.0, count - 1.0)));
}

void Timeline::mousePressEvent(QMouseEvent* event) { Choose(event->position().x()); }

void Timeline::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) Choose(event->position().x());
}

}  // namespace poselift
