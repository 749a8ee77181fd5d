// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/live_window.h"

#include <QAction>
#include <QCloseEvent>
#include <QFileDialog>
#include <QLabel>
#include <QSplitter>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <exception>
#include <utility>

#include "ui/window/key_list.h"
#include "ui/window/live_canvas.h"
#include "ui/window/live_pose.h"
#include "ui/window/main_window.h"
#include "ui/window/text_of.h"

namespace poselift {

LiveWindow::LiveWindow(std::function<LiveParts()> open, const Options& options,
                       const PhotoLifter& lifter, const KeyMap& keys)
    : open_(std::move(open)),
      options_(options),
      lifter_(lifter),
      keys_(keys),
      stills_(options.folder, options.layout) {
  setObjectName("live_window");
  setWindowTitle(tr("%1 - poselift").arg(QString::fromStdString(options.name)));
  auto* const middle = new QWidget(this);
  auto* const column = new QVBoxLayout(middle);
  problem_ = new QLabel(middle);
  problem_->setObjectName("problem");
  problem_->setAccessibleName(tr("What went wrong"));
  problem_->setWordWrap(true);
  problem_->setStyleSheet("background: #7a1f1f; color: white; padding: 8px");
  problem_->hide();
  auto* const views = new QSplitter(middle);
  picture_ = new LiveCanvas(views);
  pose_ = new LivePoseCanvas(views);
  views->setStretchFactor(0, 3);
  views->setStretchFactor(1, 2);
  views->setSizes({700, 400});
  column->addWidget(problem_);
  column->addWidget(views, 1);
  setCentralWidget(middle);
  auto* const bar = addToolBar(tr("Camera"));
  bar->setObjectName("live_bar");
  bar->setToolButtonStyle(Qt::ToolButtonTextOnly);
  freeze_ = Add(Action::kFreeze, tr("Freeze"), &LiveWindow::Freeze);
  record_ = Add(Action::kRecord, tr("Record"), &LiveWindow::ToggleRecording);
  restart_ = Add(Action::kWatchAgain, tr("Again"), &LiveWindow::Restart);
  folder_ = Add(Action::kStillFolder, tr("Folder..."), &LiveWindow::AskFolder);
  bar->addActions(
      {freeze_, record_, restart_, folder_, Add(Action::kHelp, tr("Keys"), &LiveWindow::ShowKeys)});
  folder_line_ = new QLabel(this);
  folder_line_->setObjectName("live_folder");
  folder_line_->setAccessibleName(tr("Folder of stills and recordings"));
  line_ = new QLabel(this);
  line_->setObjectName("live_line");
  line_->setAccessibleName(tr("Rate, pictures lost, delay and tags"));
  line_->setMinimumWidth(1);  // a small window stays small
  statusBar()->addWidget(line_, 1);
  statusBar()->addPermanentWidget(folder_line_);
  SetFolder(options.folder);
  resize(1180, 640);
  Restart();
}

LiveWindow::~LiveWindow() = default;

QAction* LiveWindow::Add(Action action, const QString& text, void (LiveWindow::*act)()) {
  auto* const item = new QAction(text, this);
  SetUp(item, InfoOf(action), keys_);
  connect(item, &QAction::triggered, this, act);
  return item;
}

void LiveWindow::ShowKeys() {
  ShowKeyList(this, keys_, true,
              tr("On the picture, wheel: zoom. Left button: pan. Twice: the whole picture. In the "
                 "3D view, left: turn; twice: as the camera sees it."));
}

void LiveWindow::Restart() {
  session_.reset();
  wants_recording_ = false;
  problem_->hide();
  session_ = std::make_unique<LiveSession>(open_, [this] {
    QMetaObject::invokeMethod(this, &LiveWindow::Refresh, Qt::QueuedConnection);
  });
  status_ = {};
  ShowState();
}

// An event of a session that is no more may be on its way still: it shows the newest all the same.
void LiveWindow::Refresh() {
  if (!session_) return;
  LiveSession::Latest latest = session_->Take();
  const std::filesystem::path was_recording =
      std::exchange(status_, std::move(latest.status)).recording;
  line_->setText(QString::fromStdString(StatusLine(status_, latest.view)));
  const QString no_pose = status_.has_tags ? tr("Nobody is seen yet: three tags make a pose")
                                           : tr("No tags file (--tags), so no pose");
  pose_->Show(latest.view.pose, no_pose);
  if (latest.view.number > 0) picture_->Show(std::move(latest.view));
  if (!status_.recording_message.empty() && wants_recording_) {
    wants_recording_ = false;
    ShowProblem(tr("Not recorded: %1").arg(QString::fromStdString(status_.recording_message)));
  }
  if (!was_recording.empty() && status_.recording.empty())
    folder_line_->setText(tr("%n picture(s) in %1", "", static_cast<int>(status_.num_recorded))
                              .arg(TextOf(was_recording.filename())));
  if (status_.state == LiveStatus::State::kEnded) {
    wants_recording_ = false;
    ShowProblem(QString::fromStdString(status_.message) + tr(" ('Again' starts it anew)"));
  }
  ShowState();
}

void LiveWindow::ShowState() {
  freeze_->setEnabled(status_.num_pictures > 0);
  record_->setEnabled(status_.state != LiveStatus::State::kEnded);  // from the first picture on
  record_->setText(wants_recording_ ? tr("Stop recording") : tr("Record"));
  restart_->setEnabled(status_.state == LiveStatus::State::kEnded);
}

void LiveWindow::ShowProblem(const QString& text) {
  problem_->setText(text);
  problem_->show();
}

void LiveWindow::Freeze() {
  if (!session_) return;
  const std::optional<LiveView> view = session_->Freeze();
  if (!view) return;
  try {
    const size_t frame = stills_.Add(view->bgr, [&](const Layout& layout) {
      return view->pose ? LabelsOf(*view->pose, layout) : std::vector<LandmarkLabel>();
    });
    if (!labels_) labels_ = std::make_unique<MainWindow>(stills_.project(), lifter_, keys_);
    labels_->session().GoToFrame(frame);
    labels_->Refresh();
    labels_->show();
    labels_->raise();
    labels_->activateWindow();
  } catch (const std::exception& error) {
    ShowProblem(tr("No still: %1").arg(QString::fromStdString(error.what())));
  }
}

void LiveWindow::ToggleRecording() {
  if (!session_) return;
  wants_recording_ = !wants_recording_;
  problem_->hide();
  if (wants_recording_)
    session_->Record(FreeName(stills_.folder(), "recording", ""));
  else
    session_->StopRecording();
  ShowState();
}

void LiveWindow::AskFolder() {
  const QString folder = QFileDialog::getExistingDirectory(
      this, tr("Folder of stills and recordings"), TextOf(stills_.folder()));
  if (!folder.isEmpty()) SetFolder(folder.toStdString());
}

// The labels of the folder before are saved; where they cannot be, it stays.
void LiveWindow::SetFolder(const std::filesystem::path& folder) {
  if (!CloseLabels()) return;
  stills_ = StillFolder(folder, options_.layout);
  constexpr int kLongest = 400;
  folder_line_->setText(
      folder_line_->fontMetrics().elidedText(TextOf(folder), Qt::ElideLeft, kLongest));
  folder_line_->setToolTip(TextOf(std::filesystem::absolute(folder)));
}

bool LiveWindow::CloseLabels() {
  if (labels_ && labels_->isVisible() && !labels_->close()) return false;
  labels_.reset();
  return true;
}

// A recording ends as it should; who labels may go on.
void LiveWindow::closeEvent(QCloseEvent* event) {
  session_.reset();
  event->accept();
}

}  // namespace poselift
