// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/motion_dock.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "src/joint_angles.h"
#include "ui/window/angle_plot_widget.h"
#include "ui/window/key_list.h"

namespace poselift {
namespace {

constexpr int kPoll_ms = 100, kControls = 250;

}  // namespace

MotionDock::MotionDock(LabelSession* session, const KeyMap& keys, QWidget* parent)
    : QDockWidget(tr("Motion"), parent), session_(session) {
  setObjectName("motion_dock");
  auto* const box = new QWidget(this);
  auto* const row = new QHBoxLayout(box);
  row->setContentsMargins(6, 4, 6, 4);
  row->addWidget(MakeControls(keys));
  plot_ = new AnglePlotWidget(session, box);
  row->addWidget(plot_, 1);
  setWidget(box);
  connect(plot_, &AnglePlotWidget::Chosen, this, &MotionDock::Chosen);
  connect(angles_, &QListWidget::itemChanged, this, [this] {
    std::vector<int> chosen;
    for (int a = 0; a < angles_->count(); ++a)
      if (angles_->item(a)->checkState() == Qt::Checked) chosen.push_back(a);
    plot_->SetAngles(chosen);
  });
  for (const JointAngle& angle : JointAngles()) {
    auto* const item = new QListWidgetItem(QString::fromStdString(angle.name), angles_);
    item->setToolTip(tr("positive: %1").arg(QString::fromStdString(angle.positive)));
    const bool is_first = angle.name == "left_knee.flexion" || angle.name == "right_knee.flexion";
    item->setCheckState(is_first ? Qt::Checked : Qt::Unchecked);
    if (angle.name == "left_knee.flexion") angles_->setCurrentItem(item);
  }
  angles_->scrollToItem(angles_->currentItem(), QAbstractItemView::PositionAtTop);
  timer_.setInterval(kPoll_ms);
  connect(&timer_, &QTimer::timeout, this, &MotionDock::ShowProgress);
}

QWidget* MotionDock::MakeControls(const KeyMap& keys) {
  auto* const box = new QWidget(this);
  box->setFixedWidth(kControls);
  auto* const column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  auto* const top = new QHBoxLayout;
  ask_ = new QPushButton(box);
  ask_->setObjectName("smooth");
  ask_->setToolTip(
      TipOf(tr("Lift all pictures of the person together"), Action::kSmoothMotion, keys));
  show_ = new QCheckBox(tr("Show motion"), box);
  show_->setObjectName("shows_motion");
  show_->setAccessibleName(tr("Show the motion instead of each picture by itself"));
  show_->setToolTip(TipOf(show_->accessibleName(), Action::kShowMotion, keys));
  top->addWidget(ask_, 1);
  top->addWidget(show_);
  column->addLayout(top);
  progress_ = new QProgressBar(box);
  progress_->setObjectName("motion_progress");
  progress_->setAccessibleName(tr("How much of the motion is made"));
  progress_->setRange(0, 100);
  column->addWidget(progress_);
  text_ = new QLabel(box);
  text_->setObjectName("motion_text");
  text_->setWordWrap(true);
  column->addWidget(text_);
  angles_ = new QListWidget(box);
  angles_->setObjectName("angles");
  angles_->setAccessibleName(tr("Angles to plot"));
  angles_->setMinimumHeight(50);
  column->addWidget(angles_, 1);
  connect(ask_, &QPushButton::clicked, this, &MotionDock::AskOrCancel);
  connect(show_, &QCheckBox::toggled, this, [this](bool is_on) {
    session_->shows_motion = is_on;
    emit Changed();
  });
  return box;
}

void MotionDock::AskOrCancel() {
  if (!session_->MotionProgress()) {
    emit Asked();
    return;
  }
  session_->StopMotion();
  emit Changed();
}

void MotionDock::ShowProgress() {
  const auto fraction = session_->MotionProgress();
  progress_->setValue(static_cast<int>(std::lround(100.0 * fraction.value_or(1.0))));
  if (!fraction) emit Changed();
}

QString MotionDock::Text() const {
  if (session_->MotionProgress()) return {};
  const PersonMotion* const motion = session_->motion();
  if (!motion) return tr("No motion yet");
  if (!motion->HasPoses()) return tr("No motion: the reason stands beside");
  size_t num_poses = 0;
  for (size_t f = 0; f < motion->is_filled.size(); ++f) num_poses += motion->PoseOf(f) ? 1 : 0;
  if (session_->HasKeyFrames())
    return tr("Person %1: %2 frames from %3 key frames")
        .arg(motion->person_id)
        .arg(num_poses)
        .arg(session_->labels().frames.size());
  const auto num_filled = std::ranges::count(motion->is_filled, true);
  return tr("Person %1: %2 pictures, %3 filled%4")
      .arg(motion->person_id)
      .arg(num_poses)
      .arg(num_filled)
      .arg(session_->IsMotionCurrent() ? "" : tr("; OUT OF DATE, labels have changed"));
}

void MotionDock::Refresh() {
  const bool is_busy = session_->MotionProgress().has_value();
  if (is_busy && !timer_.isActive()) timer_.start();
  if (!is_busy) timer_.stop();
  ask_->setText(is_busy                    ? tr("Cancel")
                : session_->HasKeyFrames() ? tr("Make motion")
                                           : tr("Smooth motion"));
  ask_->setAccessibleName(ask_->text());
  progress_->setVisible(is_busy);
  text_->setVisible(!is_busy);
  text_->setText(Text());
  const QSignalBlocker blocker(show_);
  show_->setChecked(session_->shows_motion);
  plot_->update();
}

}  // namespace poselift
