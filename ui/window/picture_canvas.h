// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QImage>
#include <QPointF>
#include <QString>
#include <QWidget>
#include <vector>

#include "ui/label/label_session.h"
#include "ui/label/picture_look.h"
#include "ui/label/view_transform.h"

class QPainter;

namespace poselift {

// The picture at hand with its labels and the pose that answers them. Left places and drags,
// right cycles a landmark's state, middle (or space and left) pans, the wheel zooms at the cursor.
// Right pans too where no label is. With Shift the mouse drags ten times finer; with Ctrl it moves
// all of the person, the wheel turns it, and with Shift too scales it.
class PictureCanvas : public QWidget {
  Q_OBJECT

 public:
  explicit PictureCanvas(LabelSession* session, QWidget* parent = nullptr);

  // Seen as the one before; fitted until somebody zooms or pans.
  void SetPicture(const QImage& picture);
  void SetNote(const QString& note);  // over all, in the middle; empty: none
  void Zoom(double factor);           // about the cursor, or the middle
  void Fit();
  void FullSize();
  void ZoomToBox();  // the next drag of the left button draws what is to be seen
  void Mirror();     // left and right of what is shown
  // What is shown over the picture.
  bool shows_labels = true, shows_edges = true, shows_skeleton = true, shows_loupe = false;
  bool shows_trail = true;
  PictureLook look;

  const ViewTransform& view() const { return view_; }
  QSize sizeHint() const override { return {760, 640}; }

 signals:
  void Changed();      // labels or what is at hand
  void SpaceStruck();  // with nothing panned
  void CursorAt(double x_px, double y_px);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  Eigen::Vector2d ToPicture(const QPointF& x_in_widget) const;
  QPointF ToWidget(const Eigen::Vector2d& x_px) const;
  double Reach_px() const;
  Eigen::Vector2d Fine(const QMouseEvent& event) const;
  void PaintAll(QPainter* painter, const QRectF& window) const;
  void PaintPicture(QPainter* painter, const QRectF& window) const;
  void PaintPiece(QPainter* painter, const QRectF& target, const QRectF& shown,
                  const QImage& image) const;
  void PaintLoupe(QPainter* painter);
  void FitBox(const QRectF& box);
  void PaintPose(QPainter* painter) const;
  void PaintBone(QPainter* painter, int joint, const Eigen::Matrix2Xd& joints_px,
                 const Pose3& joints_m) const;
  void PaintResiduals(QPainter* painter) const;
  void PaintTrail(QPainter* painter) const;
  void PaintEdges(QPainter* painter, const PersonLabels& person, bool is_at_hand) const;
  void PaintLabels(QPainter* painter, const PersonLabels& person, bool is_at_hand) const;

  LabelSession* session_;
  QString note_;
  std::vector<QImage> levels_;  // of the picture, each half as large as the one before
  ViewTransform view_;
  bool is_fitted_ = true;
  std::optional<QPointF> panned_from_, pressed_at_, cursor_;
  bool space_is_down_ = false, space_has_panned_ = false, next_drag_is_box_ = false;
  std::optional<QRectF> box_;  // that is being drawn
};

}  // namespace poselift
