// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/key_frames_box.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include "ui/window/key_list.h"
#include "ui/window/key_timeline.h"

namespace poselift {
namespace {

// A number is taken when it is typed to the end, by return, which is the window's key else; all of
// its keys work again then.
template <class Box>
class NumberBox : public Box {
 public:
  using Box::Box;

 protected:
  bool event(QEvent* event) override {
    const auto key =
        event->type() == QEvent::ShortcutOverride ? static_cast<QKeyEvent*>(event)->key() : 0;
    if (key == Qt::Key_Return || key == Qt::Key_Enter) event->accept();
    return Box::event(event);
  }
};

template <class Box>
Box* AddNumberBox(const char* name, const QString& accessible, QWidget* parent) {
  auto* const box = new NumberBox<Box>(parent);
  box->setObjectName(name);
  box->setAccessibleName(accessible);
  box->setKeyboardTracking(false);
  box->setFocusPolicy(Qt::ClickFocus);
  QObject::connect(box, &Box::editingFinished, box, &QWidget::clearFocus);
  return box;
}

}  // namespace

KeyFramesBox::KeyFramesBox(LabelSession* session, const KeyMap& keys, QWidget* parent)
    : QWidget(parent), session_(session) {
  timeline_ = new KeyTimeline(session, this);
  which_ = new QLabel(this);
  which_->setObjectName("key_text");
  time_ = new QLabel(this);
  number_ = AddNumberBox<QSpinBox>("key_number", tr("Frame that the key frame is on"), this);
  number_->setPrefix(tr("frame "));
  number_->setRange(0, KeyTimes::kMostNumber);
  rate_ = AddNumberBox<QDoubleSpinBox>("key_rate", tr("Frames a second"), this);
  rate_->setSuffix(tr(" frames a second"));
  rate_->setRange(1.0, 240.0);
  rate_->setDecimals(2);
  auto* const row = new QHBoxLayout;
  row->addWidget(which_);
  row->addWidget(number_);
  row->addWidget(time_);
  row->addStretch(1);
  row->addWidget(MakeButton(tr("Add"), Action::kAddKeyFrame, keys));
  row->addWidget(MakeButton(tr("Remove"), Action::kRemoveFrame, keys));
  row->addWidget(MakeButton(tr("Play"), Action::kPlay, keys));
  row->addStretch(1);
  row->addWidget(rate_);
  auto* const column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(timeline_);
  column->addLayout(row);
  connect(timeline_, &KeyTimeline::Changed, this, &KeyFramesBox::Changed);
  connect(number_, &QSpinBox::valueChanged, this, [this](int number) {
    session_->MoveKey(session_->frame_index(), number, Along::kAlone);
    emit Changed();
  });
  connect(rate_, &QDoubleSpinBox::valueChanged, this, [this](double fps) {
    session_->ChangeRate(fps);
    emit Changed();
  });
}

QPushButton* KeyFramesBox::MakeButton(const QString& text, Action action, const KeyMap& keys) {
  const ActionInfo& info = InfoOf(action);
  auto* const button = new QPushButton(text, this);
  button->setObjectName(QString("button_") + info.name.data());
  button->setAccessibleName(DescriptionOf(info));
  button->setToolTip(TipOf(info, keys));
  button->setFocusPolicy(Qt::TabFocus);
  connect(button, &QPushButton::clicked, this, [this, action] { emit Asked(action); });
  return button;
}

void KeyFramesBox::Refresh() {
  timeline_->update();
  if (!session_->HasKeyFrames()) return;
  const KeyTimes keys = session_->Keys();
  const int number = session_->Number();
  const QSignalBlocker number_blocker(number_), rate_blocker(rate_);
  number_->setValue(number);
  number_->setEnabled(!session_->IsBetween());
  rate_->setValue(keys.fps);
  time_->setText(tr("%1 s").arg(keys.Time_s(number), 0, 'f', 2));
  which_->setText(
      session_->IsBetween()
          ? tr("Between key frames:")
          : tr("Key frame %1 of %2:").arg(session_->frame_index() + 1).arg(keys.numbers.size()));
}

}  // namespace poselift
