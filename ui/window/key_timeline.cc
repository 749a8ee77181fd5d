// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/key_timeline.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "src/draw/plot_axis.h"

namespace poselift {
namespace {

constexpr double kMargin = 14.0, kMark = 7.0, kReach = 9.0, kShake = 3.0;
constexpr int kHeight = 50, kRuler = 20;

}  // namespace

KeyTimeline::KeyTimeline(LabelSession* session, QWidget* parent)
    : QWidget(parent), session_(session) {
  setObjectName("key_timeline");
  setAccessibleName(tr("Key frames in time"));
  setToolTip(
      tr("Drag a key frame to another time, with Shift all behind it too; elsewhere the mouse "
         "shows the motion between them"));
  setMouseTracking(true);
  setMinimumWidth(200);
  setFixedHeight(kHeight);
}

// With room to drag the last key frame to.
double KeyTimeline::LastNumber() const {
  if (drag_) return drag_->last;
  constexpr double kRoom = 1.25, kLeast_s = 2.0;
  const KeyTimes keys = session_->Keys();
  return std::max(
      {kLeast_s * keys.fps, kRoom * keys.numbers.back(), static_cast<double>(session_->Number())});
}

double KeyTimeline::X(int number) const {
  return kMargin + (width() - 2.0 * kMargin) * number / LastNumber();
}

int KeyTimeline::NumberAt(double x) const {
  const double part = std::clamp((x - kMargin) / (width() - 2.0 * kMargin), 0.0, 1.0);
  return static_cast<int>(std::lround(part * LastNumber()));
}

std::optional<size_t> KeyTimeline::KeyAt(double x) const {
  const KeyTimes keys = session_->Keys();
  const auto off = [&](int number) { return std::abs(X(number) - x); };
  const auto nearest = std::ranges::min_element(keys.numbers, {}, off);
  if (off(*nearest) > kReach) return std::nullopt;
  return static_cast<size_t>(nearest - keys.numbers.begin());
}

// As a release would leave them.
KeyTimes KeyTimeline::ShownKeys() const {
  KeyTimes keys = session_->Keys();
  if (!drag_ || !drag_->number) return keys;
  const LabelEdit edit =
      MoveKeyFrame(session_->labels(), keys, drag_->key, *drag_->number, drag_->along);
  for (const auto& [key, time] : edit.times) keys.numbers[key] = *time.frame;
  return keys;
}

void KeyTimeline::PaintRuler(QPainter* painter) const {
  const QColor text = palette().color(QPalette::Text);
  QColor faint = text;
  faint.setAlphaF(0.35F);
  const double num_steps = (width() - 2.0 * kMargin) / 70.0;
  // 1, 2, 5, 10 …
  const int step = static_cast<int>(std::max(1.0, TickStep({0.0, LastNumber()}, num_steps)));
  for (int number = 0; number <= LastNumber(); number += step) {
    const double x = X(number);
    painter->setPen(faint);
    painter->drawLine(QPointF(x, kRuler - 4.0), QPointF(x, kHeight));
    painter->setPen(text);
    painter->drawText(QRectF(x - 40.0, 0.0, 80.0, kRuler - 4.0), Qt::AlignCenter,
                      QString::number(number));
  }
}

// Diamonds on the line of the motion; the one at hand is full.
void KeyTimeline::PaintKeys(QPainter* painter) const {
  const KeyTimes keys = ShownKeys();
  const double y = (kRuler + kHeight) / 2.0;
  const QColor mark = palette().color(QPalette::Highlight);
  painter->setPen(QPen(mark, 3.0));
  painter->drawLine(QPointF(X(keys.numbers.front()), y), QPointF(X(keys.numbers.back()), y));
  painter->setPen(QPen(palette().color(QPalette::Text), 1.5));
  for (size_t k = 0; k < keys.numbers.size(); ++k) {
    const bool is_at_hand = k == session_->frame_index() && !session_->IsBetween();
    const QPointF at(X(keys.numbers[k]), y);
    painter->setBrush(is_at_hand ? mark : palette().color(QPalette::Base));
    painter->drawPolygon(QPolygonF({at + QPointF(0, -kMark), at + QPointF(kMark, 0),
                                    at + QPointF(0, kMark), at + QPointF(-kMark, 0)}));
  }
}

void KeyTimeline::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  if (!session_->HasKeyFrames()) return;
  painter.setRenderHint(QPainter::Antialiasing);
  PaintRuler(&painter);
  const bool is_moved = drag_ && drag_->number;
  const double x = X(is_moved ? ShownKeys().numbers[drag_->key] : session_->Number());
  painter.setPen(QPen(palette().color(QPalette::Text), 2.0));
  painter.drawLine(QPointF(x, kRuler - 6.0), QPointF(x, kHeight));
  PaintKeys(&painter);
}

void KeyTimeline::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !session_->HasKeyFrames()) return;
  const double x = event->position().x();
  if (const auto key = KeyAt(x)) {
    session_->GoToFrame(*key);
    drag_ = Drag{.key = *key, .pressed_x = x, .last = LastNumber()};
  } else {
    session_->GoToNumber(NumberAt(x));
  }
  emit Changed();
}

void KeyTimeline::mouseMoveEvent(QMouseEvent* event) {
  if (!session_->HasKeyFrames()) return;
  const double x = event->position().x();
  if (!(event->buttons() & Qt::LeftButton)) {
    setCursor(KeyAt(x) ? Qt::SizeHorCursor : Qt::ArrowCursor);
    return;
  }
  if (!drag_) {
    session_->GoToNumber(NumberAt(x));
    return emit Changed();
  }
  if (!drag_->number && std::abs(x - drag_->pressed_x) < kShake) return;
  drag_->number = NumberAt(x);
  drag_->along = event->modifiers() & Qt::ShiftModifier ? Along::kAllBehind : Along::kAlone;
  update();
}

void KeyTimeline::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !drag_) return;
  const Drag drag = *std::exchange(drag_, std::nullopt);
  if (drag.number) session_->MoveKey(drag.key, *drag.number, drag.along);
  emit Changed();
}

}  // namespace poselift
