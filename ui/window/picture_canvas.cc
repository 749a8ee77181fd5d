// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/picture_canvas.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

namespace poselift {
namespace {

constexpr double kReach = 11.0;  // of the mouse, in the widget

}  // namespace

PictureCanvas::PictureCanvas(LabelSession* session, QWidget* parent)
    : QWidget(parent), session_(session) {
  setObjectName("picture");
  setAccessibleName(tr("Picture with labels"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(200, 150);
  setCursor(Qt::CrossCursor);
}

void PictureCanvas::SetPicture(const QImage& picture) {
  levels_.assign(1, picture);
  const bool is_of_one_color = picture.depth() == 1;  // EmptyPicture
  while (!is_of_one_color && std::min(levels_.back().width(), levels_.back().height()) > 1024)
    levels_.push_back(levels_.back().scaled(levels_.back().size() / 2, Qt::IgnoreAspectRatio,
                                            Qt::SmoothTransformation));
  if (is_fitted_) Fit();
  update();
}

void PictureCanvas::SetNote(const QString& note) {
  if (std::exchange(note_, note) != note) update();
}

void PictureCanvas::Zoom(double factor) {
  QPointF at = mapFromGlobal(QCursor::pos());
  if (!rect().contains(at.toPoint())) at = QPointF(width(), height()) / 2.0;
  view_.ZoomAt({at.x(), at.y()}, factor);
  is_fitted_ = false;
  update();
}

void PictureCanvas::Fit() {
  if (levels_.empty() || levels_.front().isNull()) return;
  view_.Fit(Eigen::Vector2d(levels_.front().width(), levels_.front().height()),
            Eigen::Vector2d(width(), height()));
  is_fitted_ = true;
  update();
}

void PictureCanvas::FullSize() {
  view_.SetScaleAt(Eigen::Vector2d(width(), height()) / 2.0, 1.0);
  is_fitted_ = false;
  update();
}

void PictureCanvas::ZoomToBox() {
  next_drag_is_box_ = true;
  setCursor(Qt::SizeFDiagCursor);
}

void PictureCanvas::Mirror() {
  view_.Mirror(width());
  update();
}

Eigen::Vector2d PictureCanvas::ToPicture(const QPointF& x_in_widget) const {
  return view_.ToPicture({x_in_widget.x(), x_in_widget.y()});
}

QPointF PictureCanvas::ToWidget(const Eigen::Vector2d& x_px) const {
  const Eigen::Vector2d x = view_.ToWidget(x_px);
  return {x.x(), x.y()};
}

double PictureCanvas::Reach_px() const { return kReach / view_.scale(); }

void PictureCanvas::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::MiddleButton ||
      (event->button() == Qt::LeftButton && space_is_down_)) {
    panned_from_ = event->position();
    space_has_panned_ = true;
  } else if (event->button() == Qt::LeftButton && next_drag_is_box_) {
    box_ = QRectF(event->position(), QSizeF());
  } else if (event->button() == Qt::LeftButton) {
    pressed_at_ = event->position();
    if (event->modifiers() & Qt::ControlModifier)
      session_->PressPerson(ToPicture(event->position()));
    else
      session_->Press(ToPicture(event->position()), Reach_px());
    emit Changed();
  } else if (event->button() == Qt::RightButton) {
    if (session_->CycleStateAt(ToPicture(event->position()), Reach_px()))
      emit Changed();
    else
      panned_from_ = event->position();
  }
}

void PictureCanvas::mouseMoveEvent(QMouseEvent* event) {
  cursor_ = event->position();
  if (shows_loupe) update();
  const Eigen::Vector2d x_px = Fine(*event);
  emit CursorAt(x_px.x(), x_px.y());
  if (panned_from_) {
    const QPointF by = event->position() - *panned_from_;
    view_.Pan({by.x(), by.y()});
    is_fitted_ = false;
    panned_from_ = event->position();
    update();
  } else if (box_) {
    box_->setBottomRight(event->position());
    update();
  } else if (event->buttons() & Qt::LeftButton) {
    session_->Move(x_px);
    emit Changed();
  }
}

void PictureCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (panned_from_) {
    panned_from_.reset();
  } else if (box_) {
    FitBox(std::exchange(box_, std::nullopt)->normalized());
  } else if (event->button() == Qt::LeftButton) {
    pressed_at_.reset();
    session_->Release();
    emit Changed();
  }
}

void PictureCanvas::FitBox(const QRectF& box) {
  constexpr double kSmallest = 4.0;  // a click draws no box
  next_drag_is_box_ = false;
  setCursor(Qt::CrossCursor);
  if (box.width() >= kSmallest && box.height() >= kSmallest) {
    view_.FitBox(ToPicture(box.topLeft()), ToPicture(box.bottomRight()),
                 Eigen::Vector2d(width(), height()));
    is_fitted_ = false;
  }
  update();
}

// In the picture; while Shift is held, ten times nearer to where the button was pressed.
Eigen::Vector2d PictureCanvas::Fine(const QMouseEvent& event) const {
  constexpr double kFine = 0.1;
  if (!pressed_at_ || !(event.modifiers() & Qt::ShiftModifier)) return ToPicture(event.position());
  return ToPicture(*pressed_at_ + kFine * (event.position() - *pressed_at_));
}

void PictureCanvas::wheelEvent(QWheelEvent* event) {
  constexpr double kTurn_rad = 0.02, kClick = 120.0;
  const QPointF at = event->position();
  const double clicks = event->angleDelta().y() / kClick;
  if (event->modifiers() & Qt::ControlModifier) {
    if (event->modifiers() & Qt::ShiftModifier)
      session_->ScalePersonBy(std::pow(1.02, clicks));
    else
      session_->TurnPersonBy(kTurn_rad * clicks);
    emit Changed();
    return;
  }
  view_.ZoomAt({at.x(), at.y()}, std::pow(2.0, clicks / 4.0));
  is_fitted_ = false;
  update();
}

void PictureCanvas::keyPressEvent(QKeyEvent* event) {
  const bool is_digit = event->key() >= Qt::Key_0 && event->key() <= Qt::Key_9;
  if (event->key() == Qt::Key_Space) {
    if (!event->isAutoRepeat()) space_has_panned_ = false;
    space_is_down_ = true;
  } else if (is_digit && event->modifiers() == Qt::NoModifier) {
    session_->TypeDigit(event->key() - Qt::Key_0, static_cast<double>(event->timestamp()) / 1e3);
    emit Changed();
  } else {
    QWidget::keyPressEvent(event);
  }
}

void PictureCanvas::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Space) return QWidget::keyReleaseEvent(event);
  if (event->isAutoRepeat()) return;
  space_is_down_ = false;
  if (!space_has_panned_) emit SpaceStruck();
}

void PictureCanvas::leaveEvent(QEvent* /*event*/) {
  cursor_.reset();
  update();
}

void PictureCanvas::resizeEvent(QResizeEvent* /*event*/) {
  if (is_fitted_) Fit();
}

}  // namespace poselift
