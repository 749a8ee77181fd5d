// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/pose_canvas.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "src/draw/style.h"
#include "ui/label/in_words.h"
#include "ui/label/label_edits.h"
#include "ui/window/strokes.h"

namespace poselift {
namespace {

constexpr double kReach = 13.0;  // of the mouse, in the widget
constexpr double kMark = 6.0;    // radius of a pin

}  // namespace

PoseCanvas::PoseCanvas(LabelSession* session, QWidget* parent)
    : OrbitCanvas(parent), session_(session) {
  setObjectName("pose");
  setToolTip(
      tr("Drag a joint, with Shift its limb alone; the right button pins it. Drag elsewhere to "
         "turn, wheel to zoom, double click for the camera's view"));
  setMouseTracking(true);
}

PoseViewInput PoseCanvas::Input() const {
  PoseViewInput input{.joints_in_cam_m = session_->ShownPose()->joints_in_cam_m};
  const bool is_alone = drag_ || session_->ShowsMotion();
  for (size_t i = 0; i < session_->result().poses.size(); ++i)
    if (!is_alone && i != session_->pose_index())
      input.alternatives_in_cam_m.push_back(session_->result().poses[i].joints_in_cam_m);
  return input;
}

// The pelvis is where poses are counted from: as it is dragged, the world goes the other way.
Scene PoseCanvas::Stage() const {
  if (!drag_) return PoseStage(Input());
  Scene stage = drag_->stage;
  if (session_->handles()[drag_->handle].joint == joint::kPelvis) {
    stage.center_in_cam_m -= drag_->by_m;
    stage.base_in_cam_m -= drag_->by_m;
  }
  return stage;
}

std::optional<QPointF> PoseCanvas::HandleAt(size_t handle) const {
  if (!HasHandles()) return std::nullopt;
  const Eigen::Vector3d x_m = session_->handles()[handle].In(session_->pose()->joints_in_cam_m);
  return ToWidget(PoseProjection(Stage(), orbit(), Side_px()).Flat(x_m));
}

std::optional<size_t> PoseCanvas::Hit(const QPointF& x_in_widget) const {
  if (!HasHandles()) return std::nullopt;
  return HitHandle(session_->handles(), session_->pose()->joints_in_cam_m,
                   PoseProjection(Stage(), orbit(), Side_px()), ToPanel(x_in_widget),
                   kReach * devicePixelRatioF());
}

void PoseCanvas::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  if (!session_->ShownPose())
    return PaintMessage(&painter, QString::fromStdString(session_->result().message));
  const Scene stage = Stage();
  PaintPanel(&painter, DrawPoseFrom(Input(), orbit(), Side_px(), &stage));
  painter.setPen(Qt::black);
  painter.drawText(rect().adjusted(8, 6, -8, -6), Qt::AlignTop | Qt::AlignLeft, Kind());
  if (HasHandles()) PaintHandles(&painter);
}

// A ring around what a press takes, a diamond on what is pinned and a line to where that is wanted.
void PoseCanvas::PaintHandles(QPainter* painter) const {
  const Projection projection = PoseProjection(Stage(), orbit(), Side_px());
  painter->setRenderHint(QPainter::Antialiasing);
  const auto hovered = drag_ ? std::optional<size_t>(drag_->handle) : session_->hovered();
  for (size_t h = 0; h < session_->handles().size(); ++h) {
    const Eigen::Vector3d x_m = session_->handles()[h].In(session_->pose()->joints_in_cam_m);
    const QPointF at = ToWidget(projection.Flat(x_m));
    if (const auto wanted_m = session_->PinnedAt(h)) {
      const QPointF wanted = ToWidget(projection.Flat(*wanted_m));
      painter->setPen(QPen(ColorFrom(palette::kError), 2.0));
      if (QLineF(at, wanted).length() > kMark) painter->drawLine(at, wanted);
      painter->setPen(QPen(ColorFrom(palette::kInk), 1.5));
      painter->setBrush(ColorFrom(palette::kError));
      painter->drawPolygon(QPolygonF({at + QPointF(0, -kMark), at + QPointF(kMark, 0),
                                      at + QPointF(0, kMark), at + QPointF(-kMark, 0)}));
    }
    if (hovered != h) continue;
    painter->setBrush(Qt::NoBrush);
    painter->setPen(QPen(ColorFrom(palette::kInk), 2.0));
    painter->drawEllipse(at, 1.8 * kMark, 1.8 * kMark);
    painter->drawText(at + QPointF(2.2 * kMark, -kMark),
                      QString::fromStdString(InWords(session_->handles()[h].name)));
  }
}

// Which pose it is, once there are two kinds.
QString PoseCanvas::Kind() const {
  if (session_->HasKeyFrames()) return session_->IsBetween() ? tr("between key frames") : QString();
  const PersonMotion* const motion = session_->motion();
  if (!motion || !motion->HasPoses()) return {};
  if (!session_->ShowsMotion()) return tr("this picture alone");
  QString kind = tr("smoothed motion");
  if (motion->is_filled[session_->frame_index()]) kind += tr(", filled for want of labels");
  return session_->IsMotionCurrent() ? kind : kind + tr(", out of date");
}

void PoseCanvas::mousePressEvent(QMouseEvent* event) {
  const auto hit = Hit(event->position());
  if (event->button() == Qt::RightButton && hit && !drag_) {
    session_->TogglePin(*hit);
    emit Changed();
    return;
  }
  if (event->button() != Qt::LeftButton || drag_) return;
  if (!hit) return OrbitCanvas::mousePressEvent(event);
  const bool by_angles = event->modifiers() & Qt::ShiftModifier;
  const Scene stage = Stage();
  if (session_->PressHandle(*hit, by_angles ? PoseDrag::Way::kByAngles : PoseDrag::Way::kFree)) {
    const Eigen::Vector3d from_m = session_->handles()[*hit].In(session_->pose()->joints_in_cam_m);
    const Projection projection = PoseProjection(stage, orbit(), Side_px());
    drag_ = Drag{.handle = *hit,
                 .pressed = event->position(),
                 .grab_px = projection.Flat(from_m) - ToPanel(event->position()),
                 .from_in_cam_m = from_m,
                 .stage = stage};
  }
  emit Changed();
}

void PoseCanvas::MoveTo(const QPointF& x_in_widget) {
  constexpr double kShake = 3.0;
  drag_->is_moved |= QLineF(drag_->pressed, x_in_widget).length() > kShake;
  if (!drag_->is_moved) return;
  const Eigen::Vector3d to_m =
      PoseProjection(drag_->stage, orbit(), Side_px())
          .InCam(ToPanel(x_in_widget) + drag_->grab_px, drag_->from_in_cam_m);
  drag_->by_m = to_m - drag_->from_in_cam_m;
  session_->MoveHandle(to_m);
  emit Changed();
}

void PoseCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (drag_) return MoveTo(event->position());
  if (event->buttons() == Qt::NoButton) {
    const auto hit = Hit(event->position());
    if (hit == session_->hovered()) return;
    session_->Hover(hit);
    setCursor(hit ? Qt::PointingHandCursor : Qt::ArrowCursor);
    emit Changed();
    return;
  }
  OrbitCanvas::mouseMoveEvent(event);
}

void PoseCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  OrbitCanvas::mouseReleaseEvent(event);
  if (!drag_) return;
  drag_.reset();
  session_->Release();
  emit Changed();
}

void PoseCanvas::leaveEvent(QEvent* /*event*/) {
  if (!session_->hovered()) return;
  session_->Hover({});
  emit Changed();
}

}  // namespace poselift
