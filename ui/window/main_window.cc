// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/main_window.h"

#include <QAction>
#include <QDateTime>
#include <QDockWidget>
#include <QInputDialog>
#include <QKeyEvent>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QSplitter>
#include <QStatusBar>
#include <QTimer>
#include <exception>
#include <utility>

#include "ui/window/key_frames_box.h"
#include "ui/window/key_list.h"
#include "ui/window/motion_dock.h"
#include "ui/window/picture_canvas.h"
#include "ui/window/player.h"
#include "ui/window/pose_canvas.h"
#include "ui/window/text_of.h"
#include "ui/window/timeline.h"

namespace poselift {
namespace {

constexpr double kZoomStep = 1.25;
constexpr int kLong_ms = 15000;  // a message stays

double Now_s() { return static_cast<double>(QDateTime::currentMSecsSinceEpoch()) / 1e3; }

}  // namespace

MainWindow::MainWindow(LabelProject* project, const PhotoLifter& lifter, const KeyMap& keys,
                       VideoTimes times)
    : lifter_(lifter),
      keys_(keys),
      pictures_(project->dir(), std::move(times)),
      reading_(InWindow(&MainWindow::TakePicture)),
      session_(project, lifter, InWindow(&MainWindow::TakeAnswers)) {
  setObjectName("window");
  auto* const middle = new QSplitter(this);
  middle->setObjectName("views");
  picture_ = new PictureCanvas(&session_, middle);
  pose_ = new PoseCanvas(&session_, middle);
  middle->setStretchFactor(0, 3);
  middle->setStretchFactor(1, 2);
  middle->setSizes({600, 400});
  setCentralWidget(middle);
  AddJoints();
  AddFrames();
  AddHints();
  AddLook();
  AddMotion();
  status_ = new QLabel(this);
  status_->setObjectName("status");
  cursor_ = new QLabel(this);
  cursor_->setObjectName("cursor");
  statusBar()->addWidget(status_, 1);
  statusBar()->addPermanentWidget(cursor_);
  AddMenus();
  connect(picture_, &PictureCanvas::Changed, this, &MainWindow::Refresh);
  connect(picture_, &PictureCanvas::SpaceStruck, this, [this] { Do(Action::kSuggested); });
  connect(pose_, &PoseCanvas::Changed, this, &MainWindow::Refresh);
  connect(picture_, &PictureCanvas::CursorAt, this, [this](double x_px, double y_px) {
    cursor_->setText(QString("%1, %2").arg(x_px, 0, 'f', 1).arg(y_px, 0, 'f', 1));
  });
  auto* const clock = new QTimer(this);
  connect(clock, &QTimer::timeout, this, [this] {
    if (!session_.Working().empty()) status_->setText(QString::fromStdString(session_.Status()));
    SayReading();
  });
  constexpr int kOften_ms = 200;
  clock->start(kOften_ms);
  resize(1280, 800);
  picture_->setFocus();
  Refresh();
  QStringList messages;
  for (const std::string& message : project->messages())
    messages << QString::fromStdString(message);
  if (!messages.isEmpty()) statusBar()->showMessage(messages.join("; "), kLong_ms);
}

// For other threads, to call at any time.
std::function<void()> MainWindow::InWindow(void (MainWindow::*act)()) {
  return [this, act] { QMetaObject::invokeMethod(this, act, Qt::QueuedConnection); };
}

QAction* MainWindow::Add(QMenu* menu, Action action) {
  auto* const item = new QAction(menu);
  SetUp(item, InfoOf(action), keys_);
  item->setAutoRepeat(!Shown(action));
  menu->addAction(item);
  connect(item, &QAction::triggered, this, [this, action] { Do(action); });
  actions_[action] = item;
  return item;
}

void MainWindow::AddMenus() {
  auto* const file = menuBar()->addMenu(tr("&File"));
  file->addAction(tr("&Open..."), QKeySequence(QKeySequence::Open), this, &MainWindow::Open)
      ->setObjectName("open");
  file->addAction(tr("Watch a &camera..."), this, &MainWindow::WatchCamera)
      ->setObjectName("watch_camera");
  file->addAction(tr("&New pose..."), this, &MainWindow::NewPose)->setObjectName("new_pose");
  Add(file, Action::kSave);
  file->addAction(tr("&Find moved pictures..."), this, &MainWindow::FindPictures)
      ->setObjectName("find_pictures");
  file->addAction(tr("&Export..."), this, &MainWindow::AskExport)->setObjectName("export");
  file->addAction(tr("Export &motion..."), this, &MainWindow::AskExportMotion)
      ->setObjectName("export_motion");
  file->addAction(tr("Save s&creenshot..."), this, &MainWindow::SaveScreenshot)
      ->setObjectName("screenshot");
  file->addSeparator();
  file->addAction(tr("&Quit"), QKeySequence(QKeySequence::Quit), this, &QWidget::close)
      ->setObjectName("quit");
  struct Menu {
    QString title;
    std::vector<Action> actions;
  };
  using enum Action;
  const std::vector<Menu> menus = {
      {tr("&Edit"),
       {kUndo, kRedo, kCycleState, kRemove, kCopyPrevious, kNudgeLeft, kNudgeRight, kNudgeUp,
        kNudgeDown, kStepLeft, kStepRight, kStepUp, kStepDown, kCopy, kPaste}},
      {tr("Pe&rson"), {kNextPerson, kNewPerson, kRemovePerson, kSwapSides}},
      {tr("Pi&ctures"),
       {kFollowAll, kFollowForwards, kFollowBackwards, kPosesBetween, kCopyFollowed, kAccept,
        kStop}},
      {tr("&Go"), {kNextJoint, kPreviousJoint, kNextFrame,      kPreviousFrame, kForward10,
                   kBack10,    kForward100,    kBack100,        kFirstFrame,    kLastFrame,
                   kNextVideo, kPreviousVideo, kNextUnlabelled, kNextLabelled,  kPreviousLabelled,
                   kSuggested, kLastChanged,   kStepBack,       kStepForward,   kPlay}},
      {tr("&Pose"),
       {kNextPose, kKeepPose, kFlipLimb, kTowardsCamera, kAwayFromCamera, kNearer, kOnFloor,
        kForgetHints, kPinJoint, kAddKeyFrame, kRemoveFrame, kKeyEarlier, kKeyLater, kSmoothMotion,
        kShowMotion}},
      {tr("&View"),
       {kZoomIn, kZoomOut, kFit, kFullSize, kZoomToBox, kMirrorView, kToggleLoupe, kToggleLabels,
        kToggleEdges, kToggleSkeleton, kToggleTrail}},
      {tr("&Help"), {kHelp}}};
  for (const Menu& menu : menus) {
    auto* const items = menuBar()->addMenu(menu.title);
    for (const Action action : menu.actions) Add(items, action);
    if (menu.actions.front() == kNextPose)
      items->addAction(tr("Height of the person..."), this, &MainWindow::AskHeight)
          ->setObjectName("height");
    if (menu.actions.front() == kZoomIn)
      for (QDockWidget* dock : docks_) items->addAction(dock->toggleViewAction());
  }
}

// What a key shows and hides; null for other actions.
bool* MainWindow::Shown(Action action) const {
  switch (action) {
    case Action::kToggleLoupe:
      return &picture_->shows_loupe;
    case Action::kToggleLabels:
      return &picture_->shows_labels;
    case Action::kToggleEdges:
      return &picture_->shows_edges;
    case Action::kToggleSkeleton:
      return &picture_->shows_skeleton;
    case Action::kToggleTrail:
      return &picture_->shows_trail;
    default:
      return nullptr;
  }
}

void MainWindow::keyReleaseEvent(QKeyEvent* event) {
  const QKeySequence key(event->keyCombination());
  for (const auto& [action, item] : actions_) {
    if (event->isAutoRepeat() || !Shown(action) || !item->shortcuts().contains(key)) continue;
    if (peek_.Release(action, Now_s())) *Shown(action) = !*Shown(action);
    Refresh();
  }
  QMainWindow::keyReleaseEvent(event);
}

void MainWindow::Do(Action action) {
  if (bool* const shown = Shown(action)) {
    *shown = !*shown;
    peek_.Press(action, Now_s());
    return Refresh();
  }
  switch (action) {
    case Action::kZoomIn:
      return picture_->Zoom(kZoomStep);
    case Action::kZoomOut:
      return picture_->Zoom(1.0 / kZoomStep);
    case Action::kFit:
      return picture_->Fit();
    case Action::kFullSize:
      return picture_->FullSize();
    case Action::kZoomToBox:
      return picture_->ZoomToBox();
    case Action::kMirrorView:
      return picture_->Mirror();
    case Action::kNextFrame:
    case Action::kPreviousFrame:
      for (int i = repeat_.Step(Now_s()); i > 0; --i) Try([&] { session_.Do(action); });
      break;
    case Action::kHelp:
      return ShowKeys();
    case Action::kPlay:
      return player_->Toggle();
    case Action::kSmoothMotion:
      motion_->show();
      session_.Do(action);
      break;
    default:
      Try([&] { session_.Do(action); });
  }
  Refresh();
}

// What cannot be done is said; all that was done before stays.
bool MainWindow::Try(const std::function<void()>& act) {
  try {
    act();
    return true;
  } catch (const std::exception& error) {
    Tell(QString::fromStdString(error.what()));
    return false;
  }
}

void MainWindow::Tell(const QString& text) {
  auto* const box =
      new QMessageBox(QMessageBox::Warning, tr("poselift"), text, QMessageBox::Ok, this);
  box->setObjectName("message");
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

void MainWindow::ShowKeys() {
  ShowKeyList(this, keys_, false,
              tr("Left button: place the joint at hand, or drag any. Right button: visible, "
                 "occluded, absent. Middle button, or space and left, or right where no joint is: "
                 "pan. Space alone: the picture where labels would tell most. Wheel: zoom. Held, "
                 "the keys that hide something do so until they are let go. Digits: to the joint "
                 "of that number. In the 3D view, left: "
                 "drag a joint, with Shift its limb alone, or turn. Right: pin a joint."));
}

void MainWindow::AskHeight() {
  bool is_given = false;
  const double height_cm = QInputDialog::getDouble(this, tr("Height of the person"),
                                                   tr("From the soles to the crown, cm"), 175.0,
                                                   30.0, 250.0, 1, &is_given);
  if (is_given) session_.GiveHeight(height_cm / 100.0);
  Refresh();
}

void MainWindow::TakeAnswers() {
  if (session_.TakeAnswer()) Refresh();
  SayExported();
}

void MainWindow::Refresh() {
  ShowPicture();
  ShowJoints();
  ShowProgress();
  ShowHints();
  setWindowTitle(QString::fromStdString(session_.Title()));
  status_->setText(QString::fromStdString(session_.Status()));
  if (actions_.count(Action::kUndo) != 0) {
    const LabelHistory& history = session_.project().history();
    actions_[Action::kUndo]->setText(tr("Undo %1").arg(TextOf(history.UndoName())));
    actions_[Action::kRedo]->setText(tr("Redo %1").arg(TextOf(history.RedoName())));
    actions_[Action::kUndo]->setEnabled(history.CanUndo());
    actions_[Action::kRedo]->setEnabled(history.CanRedo());
  }
  picture_->update();
  pose_->update();
  timeline_->update();
  if (key_frames_) key_frames_->Refresh();
  motion_->Refresh();
}

// What was said before there was a window hides the status line only now.
void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  const QString message = statusBar()->currentMessage();
  statusBar()->clearMessage();
  if (!message.isEmpty()) statusBar()->showMessage(message, kLong_ms);
}

}  // namespace poselift
