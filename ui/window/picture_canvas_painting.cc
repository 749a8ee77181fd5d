// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What the canvas shows: picture, labels, pose, loupe.
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "src/draw/style.h"
#include "ui/label/in_words.h"
#include "ui/label/label_edits.h"
#include "ui/label/layout_edges.h"
#include "ui/window/picture_canvas.h"
#include "ui/window/strokes.h"

namespace poselift {
namespace {

constexpr double kMark = 5.0;  // radius of a label

}  // namespace

void PictureCanvas::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().color(QPalette::Dark));
  PaintAll(&painter, rect());
  if (shows_loupe && cursor_) PaintLoupe(&painter);
  if (!note_.isEmpty()) {
    painter.setPen(Qt::black);
    painter.drawText(rect(), Qt::AlignCenter, note_);
  }
  if (!box_) return;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(palette().color(QPalette::Highlight), 1.5, Qt::DashLine));
  painter.drawRect(*box_);
}

void PictureCanvas::PaintAll(QPainter* painter, const QRectF& window) const {
  PaintPicture(painter, window);
  if (shows_skeleton) PaintPose(painter);
  if (shows_trail) PaintTrail(painter);
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

// Of the landmark at hand: what was is a line, what comes are dots, both the fainter the farther.
void PictureCanvas::PaintTrail(QPainter* painter) const {
  const std::string_view name =
      session_->layout().landmarks[static_cast<size_t>(session_->landmark())].name;
  const QColor color = ColorFrom(ColorOf(SideOf(name)));
  const TrailPoint* before = nullptr;
  const std::vector<TrailPoint> trail = session_->Trail();
  for (const TrailPoint& point : trail) {
    painter->setOpacity(1.0 - 0.6 * std::abs(point.away) / TrailPoint::kMostAway);
    if (before && before->away + 1 == point.away) {
      QPainterPath way(ToWidget(before->x_px));
      way.lineTo(ToWidget(point.x_px));
      if (point.away <= 0) StrokeTwice(painter, way, color, 1.5);
    }
    painter->setPen(QPen(ColorFrom(palette::kInk), 0.8));
    painter->setBrush(color);
    painter->drawEllipse(ToWidget(point.x_px), 2.2, 2.2);
    before = &point;
  }
  painter->setOpacity(1.0);
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
                        QString::fromStdString(InWords(label->name)));
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

}  // namespace poselift
