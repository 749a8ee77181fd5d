// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/picture_canvas.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "src/draw/style.h"
#include "ui/label/layout_edges.h"
#include "ui/window/strokes.h"

namespace poselift {
namespace {

constexpr double kReach = 11.0;  // of the mouse, in the widget
constexpr double kMark = 5.0;    // radius of a label

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
  while (std::min(levels_.back().width(), levels_.back().height()) > 1024)
    levels_.push_back(levels_.back().scaled(levels_.back().size() / 2, Qt::IgnoreAspectRatio,
                                            Qt::SmoothTransformation));
  if (is_fitted_) Fit();
  update();
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

void PictureCanvas::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().color(QPalette::Dark));
  PaintAll(&painter, rect());
  if (shows_loupe && cursor_) PaintLoupe(&painter);
  if (!box_) return;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(palette().color(QPalette::Highlight), 1.5, Qt::DashLine));
  painter.drawRect(*box_);
}

void PictureCanvas::PaintAll(QPainter* painter, const QRectF& window) const {
  PaintPicture(painter, window);
  if (shows_skeleton) PaintPose(painter);
  const FrameLabels frame = session_->Frame();
  for (size_t p = 0; p < frame.people.size(); ++p) {
    const bool is_at_hand = p == session_->person_index();
    if (shows_edges) PaintEdges(painter, frame.people[p], is_at_hand);
    if (shows_labels) PaintLabels(painter, frame.people[p], is_at_hand);
  }
}

// What is around the cursor, large, in the upper corner that is farther from it.
void PictureCanvas::PaintLoupe(QPainter* painter) {
  constexpr double kSide = 180.0, kZoom = 6.0, kMargin = 10.0;
  const QRectF window(cursor_->x() < width() / 2.0 ? width() - kSide - kMargin : kMargin, kMargin,
                      kSide, kSide);
  const ViewTransform view = view_;
  const Eigen::Vector2d x_px = ToPicture(*cursor_);
  const Eigen::Vector2d middle(window.center().x(), window.center().y());
  view_.SetScaleAt(Eigen::Vector2d(cursor_->x(), cursor_->y()), kZoom * view.scale());
  view_.Pan(middle - view_.ToWidget(x_px));
  painter->save();
  painter->setClipRect(window);
  painter->fillRect(window, palette().color(QPalette::Dark));
  PaintAll(painter, window);
  painter->setPen(QPen(palette().color(QPalette::Highlight), 1.0));
  painter->drawLine(QPointF(middle.x(), window.top()), QPointF(middle.x(), window.bottom()));
  painter->drawLine(QPointF(window.left(), middle.y()), QPointF(window.right(), middle.y()));
  painter->restore();
  painter->setBrush(Qt::NoBrush);
  painter->setPen(QPen(palette().color(QPalette::Highlight), 1.0));
  painter->drawRect(window);
  view_ = view;
}

// Of the window what shows the picture, by the smallest level that has a pixel for each of the
// screen.
void PictureCanvas::PaintPicture(QPainter* painter, const QRectF& window) const {
  if (levels_.empty() || levels_.front().isNull()) return;
  size_t level = 0;
  const double wanted = 1.0 / (view_.scale() * devicePixelRatioF());
  while (level + 1 < levels_.size() && std::pow(2.0, static_cast<double>(level + 1)) <= wanted)
    ++level;
  const QSizeF size = levels_.front().size();
  const Eigen::Vector2d last(size.width() - 0.5, size.height() - 0.5);
  const QRectF seen = QRectF(ToWidget(Eigen::Vector2d(-0.5, -0.5)), ToWidget(last)).normalized();
  painter->save();
  if (view_.is_mirrored()) {
    painter->translate(window.left() + window.right(), 0.0);
    painter->scale(-1.0, 1.0);
  }
  const QRectF target =
      view_.is_mirrored()
          ? seen.translated(window.left() + window.right() - seen.left() - seen.right(), 0.0)
          : seen;
  PaintPiece(painter, target, target.intersected(window), levels_[level]);
  painter->restore();
}

// A piece of a picture that would fill the target.
void PictureCanvas::PaintPiece(QPainter* painter, const QRectF& target, const QRectF& shown,
                               const QImage& image) const {
  if (shown.isEmpty()) return;
  const double x_scale = image.width() / target.width(), y_scale = image.height() / target.height();
  const QRectF source((shown.left() - target.left()) * x_scale,
                      (shown.top() - target.top()) * y_scale, shown.width() * x_scale,
                      shown.height() * y_scale);
  painter->setRenderHint(QPainter::SmoothPixmapTransform, view_.scale() < 4.0);
  if (look.IsPlain()) return painter->drawImage(shown, image, source);
  const QRect whole = source.toAlignedRect().intersected(image.rect());
  QImage piece = image.copy(whole);
  const cv::Mat pixels(piece.height(), piece.width(), CV_8UC4, piece.bits(),
                       static_cast<size_t>(piece.bytesPerLine()));
  cv::LUT(pixels, look.Table(), pixels);
  painter->drawImage(shown, piece, source.translated(-whole.topLeft()));
}

void PictureCanvas::PaintEdges(QPainter* painter, const PersonLabels& person,
                               bool is_at_hand) const {
  const Layout& layout = session_->layout();
  painter->setOpacity(is_at_hand ? 0.75 : 0.35);
  for (const auto& [a, b] : LayoutEdges(layout)) {
    const LandmarkLabel* from =
        LabelSession::Find(person, layout.landmarks[static_cast<size_t>(a)].name);
    const LandmarkLabel* to =
        LabelSession::Find(person, layout.landmarks[static_cast<size_t>(b)].name);
    if (!from || !to || from->state == LabelState::kAbsent || to->state == LabelState::kAbsent)
      continue;
    QPainterPath path(ToWidget(from->x_px));
    path.lineTo(ToWidget(to->x_px));
    StrokeTwice(painter, path, ColorFrom(ColorOf(SideOf(to->name))), 1.5,
                to->state == LabelState::kOccluded ? Qt::DotLine : Qt::SolidLine);
  }
  painter->setOpacity(1.0);
}

void PictureCanvas::PaintLabels(QPainter* painter, const PersonLabels& person,
                                bool is_at_hand) const {
  const Layout& layout = session_->layout();
  painter->setOpacity(is_at_hand ? 1.0 : 0.5);
  for (size_t l = 0; l < layout.landmarks.size(); ++l) {
    const LandmarkLabel* label = LabelSession::Find(person, layout.landmarks[l].name);
    if (!label || label->state == LabelState::kAbsent) continue;
    const QPointF at = ToWidget(label->x_px);
    const bool is_current = is_at_hand && static_cast<int>(l) == session_->landmark();
    QPainterPath mark;
    const double radius = is_current ? 1.6 * kMark : kMark;
    if (SideOf(label->name) == Side::kRight)
      mark.addRect(QRectF(at.x() - radius, at.y() - radius, 2.0 * radius, 2.0 * radius));
    else
      mark.addEllipse(at, radius, radius);
    StrokeTwice(painter, mark, ColorFrom(ColorOf(SideOf(label->name))), 2.0,
                label->state == LabelState::kOccluded ? Qt::DotLine : Qt::SolidLine);
    if (is_current)
      painter->drawText(at + QPointF(radius + 4.0, -radius),
                        QString::fromStdString(label->name).replace('_', ' '));
  }
  painter->setOpacity(1.0);
}

// Where the pose has the joints.
void PictureCanvas::PaintPose(QPainter* painter) const {
  const LiftedPose* pose = session_->ShownPose();
  if (!pose) return;
  const Eigen::Matrix2Xd joints_px = session_->PictureCamera().Project(pose->joints_in_cam_m);
  painter->setOpacity(0.65);
  for (int j = 1; j < kNumJoints; ++j) PaintBone(painter, j, joints_px, pose->joints_in_cam_m);
  painter->setOpacity(1.0);
  PaintResiduals(painter);
}

// The bone that ends at a joint: near it is broad and bright, far away thin and dark.
void PictureCanvas::PaintBone(QPainter* painter, int joint, const Eigen::Matrix2Xd& joints_px,
                              const Pose3& joints_m) const {
  constexpr double kFar_m = 0.6, kBroad = 6.0, kThin = 2.0, kDark = 0.6;
  const int before = Joints()[static_cast<size_t>(joint)].parent;
  if (!joints_px.col(joint).allFinite() || !joints_px.col(before).allFinite()) return;
  QPainterPath bone(ToWidget(joints_px.col(before)));
  bone.lineTo(ToWidget(joints_px.col(joint)));
  const double depth_m = (joints_m(2, joint) + joints_m(2, before)) / 2.0;
  const double far = std::clamp(0.5 + 0.5 * depth_m / kFar_m, 0.0, 1.0);
  StrokeTwice(painter, bone, ColorFrom(Mixed(ColorOf(SideOf(joint)), palette::kInk, kDark * far)),
              kBroad + far * (kThin - kBroad));
}

// From the labels to where the pose has them.
void PictureCanvas::PaintResiduals(QPainter* painter) const {
  const LiftedPose* pose = session_->ShownPose();
  for (const ObservedPoint& point : session_->observation().points) {
    if (point.kind != ObservedPoint::Kind::k2D) continue;
    const Eigen::Vector3d x_m = SumOfJoints(point.parts, pose->joints_in_cam_m);
    const Eigen::Vector2d x_px =
        pose->camera.scale_px_per_m * x_m.head<2>() + pose->camera.translation_px;
    QPainterPath residual(ToWidget(point.x.head<2>()));
    residual.lineTo(ToWidget(x_px));
    StrokeTwice(painter, residual, ColorFrom(palette::kError), 2.0);
  }
}

void PictureCanvas::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::MiddleButton ||
      (event->button() == Qt::LeftButton && space_is_down_)) {
    panned_from_ = event->position();
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
    space_is_down_ = true;
  } else if (is_digit && event->modifiers() == Qt::NoModifier) {
    session_->TypeDigit(event->key() - Qt::Key_0, static_cast<double>(event->timestamp()) / 1e3);
    emit Changed();
  } else {
    QWidget::keyPressEvent(event);
  }
}

void PictureCanvas::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat())
    space_is_down_ = false;
  else
    QWidget::keyReleaseEvent(event);
}

void PictureCanvas::leaveEvent(QEvent* /*event*/) {
  cursor_.reset();
  update();
}

void PictureCanvas::resizeEvent(QResizeEvent* /*event*/) {
  if (is_fitted_) Fit();
}

}  // namespace poselift
