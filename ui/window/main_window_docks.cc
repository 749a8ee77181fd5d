// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What stands around the views: joints, hints, pictures, the look of the picture.
#include <QDockWidget>
#include <QFormLayout>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <cmath>
#include <optional>

#include "src/draw/style.h"
#include "src/joint_relation.h"
#include "ui/label/in_words.h"
#include "ui/label/label_edits.h"
#include "ui/window/key_frames_box.h"
#include "ui/window/main_window.h"
#include "ui/window/picture_canvas.h"
#include "ui/window/timeline.h"

namespace poselift {
namespace {

QString StateText(const LandmarkLabel* label) {
  if (!label) return MainWindow::tr("none");
  switch (label->state) {
    case LabelState::kVisible:
      return MainWindow::tr("visible");
    case LabelState::kOccluded:
      return MainWindow::tr("occluded");
    case LabelState::kAbsent:
      return MainWindow::tr("absent");
  }
  return {};
}

// That of errors, the stronger the farther the pose is off for a label as sure as this one; that of
// any text where it is near.
QVariant ResidualColor(std::optional<double> sigmas) {
  constexpr double kNear = 1.0, kFar = 3.0, kFaint = 0.5;
  if (sigmas.value_or(0.0) <= kNear) return {};
  const cv::Scalar& error = palette::kError;
  QColor color(static_cast<int>(error[2]), static_cast<int>(error[1]), static_cast<int>(error[0]));
  const double part = std::min(1.0, (*sigmas - kNear) / (kFar - kNear));
  color.setAlphaF(static_cast<float>(kFaint + (1.0 - kFaint) * part));
  return color;
}

}  // namespace

void MainWindow::AddJoints() {
  auto* const dock = joints_dock_ = new QDockWidget(tr("Joints"), this);
  dock->setObjectName("joints_dock");
  joints_ = new QListWidget(dock);
  joints_->setObjectName("joints");
  joints_->setAccessibleName(tr("Joints, their states and residuals"));
  joints_->setMinimumWidth(210);
  dock->setWidget(joints_);
  docks_.push_back(dock);
  addDockWidget(Qt::LeftDockWidgetArea, dock);
  connect(joints_, &QListWidget::currentRowChanged, this, [this](int row) {
    if (row >= 0) session_.GoToLandmark(row);
    Refresh();
  });
}

void MainWindow::AddFrames() {
  const bool has_keys = session_.HasKeyFrames();
  auto* const dock = frames_dock_ =
      new QDockWidget(has_keys ? tr("Key frames") : tr("Pictures"), this);
  dock->setObjectName("frames_dock");
  auto* const box = new QWidget(dock);
  auto* const column = new QVBoxLayout(box);
  timeline_ = new Timeline(&session_, box);
  frames_ = new QSlider(Qt::Horizontal, box);
  frames_->setObjectName("frames");
  frames_->setAccessibleName(tr("Picture"));
  column->addWidget(timeline_);
  column->addWidget(frames_);
  if (has_keys) AddKeyFrames(box);
  dock->setWidget(box);
  docks_.push_back(dock);
  addDockWidget(Qt::BottomDockWidgetArea, dock);
  connect(timeline_, &Timeline::Chosen, frames_, &QSlider::setValue);
  connect(frames_, &QSlider::valueChanged, this, [this](int value) {
    session_.GoToFrame(static_cast<size_t>(value));
    Refresh();
  });
}

void MainWindow::AddKeyFrames(QWidget* box) {
  timeline_->hide();
  frames_->hide();
  key_frames_ = new KeyFramesBox(&session_, keys_, box);
  box->layout()->addWidget(key_frames_);
  connect(key_frames_, &KeyFramesBox::Changed, this, &MainWindow::Refresh);
  connect(key_frames_, &KeyFramesBox::Asked, this, &MainWindow::Do);
}

void MainWindow::AddHints() {
  auto* const dock = new QDockWidget(tr("Hints"), this);
  dock->setObjectName("hints_dock");
  hints_ = new QListWidget(dock);
  hints_->setObjectName("hints");
  hints_->setWordWrap(true);
  hints_->setAccessibleName(tr("Hints, forgotten by a double click or the enter key"));
  hints_->setToolTip(tr("What no joint shows, from the menu Pose; a double click forgets one"));
  dock->setWidget(hints_);
  addDockWidget(Qt::LeftDockWidgetArea, dock);
  docks_.push_back(dock);
  connect(hints_, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) {
    session_.RemoveHintAt(static_cast<size_t>(hints_->row(item)));
    Refresh();
  });
}

// Hidden at first: of use in the dark.
void MainWindow::AddLook() {
  auto* const dock = new QDockWidget(tr("Look of the picture"), this);
  dock->setObjectName("look_dock");
  auto* const box = new QWidget(dock);
  auto* const rows = new QFormLayout(box);
  struct Row {
    const char* name;
    QString text;
    double PictureLook::*value;
    bool is_factor;  // of 10 either way, else a sum
  };
  std::vector<QSlider*> sliders;
  for (const Row& row : {Row{"brightness", tr("Brightness"), &PictureLook::brightness, false},
                         Row{"contrast", tr("Contrast"), &PictureLook::contrast, true},
                         Row{"gamma", tr("Gamma"), &PictureLook::gamma, true}}) {
    auto* const slider = new QSlider(Qt::Horizontal, box);
    slider->setObjectName(row.name);
    slider->setAccessibleName(row.text);
    slider->setRange(-100, 100);
    rows->addRow(row.text, slider);
    sliders.push_back(slider);
    connect(slider, &QSlider::valueChanged, this, [this, row](int at) {
      picture_->look.*row.value = row.is_factor ? std::pow(10.0, at / 100.0) : at / 100.0;
      picture_->update();
    });
  }
  auto* const plain = new QPushButton(tr("As it is"), box);
  plain->setObjectName("plain_look");
  plain->setAccessibleName(tr("Show the picture as it is"));
  rows->addRow(plain);
  connect(plain, &QPushButton::clicked, this, [sliders] {
    for (QSlider* slider : sliders) slider->setValue(0);
  });
  dock->setWidget(box);
  addDockWidget(Qt::LeftDockWidgetArea, dock);
  dock->hide();
  docks_.push_back(dock);
}

void MainWindow::ShowJoints() {
  const QSignalBlocker blocker(joints_);
  const Layout& layout = session_.layout();
  const FrameLabels frame = session_.Frame();
  const PersonLabels* const person = session_.person_index() < frame.people.size()
                                         ? &frame.people[session_.person_index()]
                                         : nullptr;
  while (joints_->count() < static_cast<int>(layout.landmarks.size())) joints_->addItem("");
  for (size_t l = 0; l < layout.landmarks.size(); ++l) {
    const std::string_view name = layout.landmarks[l].name;
    QString text = QString("%1 ").arg(l + 1) + QString::fromStdString(InWords(name)) + ": " +
                   StateText(person ? LabelSession::Find(*person, name) : nullptr);
    if (const auto residual_px = session_.Residual_px(name))
      text += tr(", %1 px").arg(*residual_px, 0, 'f', 1);
    QListWidgetItem* const item = joints_->item(static_cast<int>(l));
    item->setText(text);
    item->setData(Qt::ForegroundRole, ResidualColor(session_.ResidualInSigmas(name)));
  }
  joints_->setCurrentRow(session_.landmark());
}

// How much of the work is done.
void MainWindow::ShowProgress() {
  const int num_joints = static_cast<int>(session_.layout().landmarks.size());
  joints_dock_->setWindowTitle(tr("Joints: %1 of %2").arg(session_.NumLabels()).arg(num_joints));
  const size_t num_frames = session_.labels().frames.size();
  if (key_frames_ || num_frames < 2) return;
  const size_t done = session_.NumLabelledFrames();
  frames_dock_->setWindowTitle(tr("Pictures: %1 of %2 labelled by hand, %3 %")
                                   .arg(done)
                                   .arg(num_frames)
                                   .arg(100 * done / num_frames));
}

void MainWindow::ShowHints() {
  hints_->clear();
  const std::vector<LabelHint> hints = session_.Hints();
  const std::vector<int> unmet =
      session_.pose() ? session_.pose()->unmet_hints : std::vector<int>();
  for (size_t h = 0; h < hints.size(); ++h) {
    QString text = QString::fromStdString(InWords(hints[h]));
    if (std::ranges::count(unmet, static_cast<int>(h)) > 0) text += tr(" (not met)");
    hints_->addItem(text);
    // Of a pose that was dragged there is one a joint: nothing to read.
    hints_->item(static_cast<int>(h))->setHidden(IsSoftPin(hints[h]));
  }
}

}  // namespace poselift
