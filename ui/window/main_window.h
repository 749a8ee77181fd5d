// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QImage>
#include <QMainWindow>
#include <functional>
#include <map>
#include <vector>

#include "ui/label/background_job.h"
#include "ui/label/frame_pictures.h"
#include "ui/label/key_map.h"
#include "ui/label/label_session.h"

class QAction;
class QDockWidget;
class QLabel;
class QListWidget;
class QSlider;

namespace poselift {

class KeyFramesBox;
class MotionDock;
class PictureCanvas;
class Player;
class PoseCanvas;
class Timeline;

// The labelling window: the picture, the pose that answers, the list of joints, the frames. It
// holds no labels: it paints a LabelSession and forwards to it.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  // project and lifter must outlive the window. times: see FramePictures.
  MainWindow(LabelProject* project, const PhotoLifter& lifter, const KeyMap& keys,
             VideoTimes times = {});

  LabelSession& session() { return session_; }
  // All of the results of `lift` in a folder, in the background; says when they are there, or what
  // went wrong.
  void ExportTo(const QString& folder);
  void ExportMotionTo(const QString& file);    // as the file's ending says
  void FindPicturesIn(const QString& folder);  // that are no more where the labels say
  void WaitForPicture();                       // of the frame at hand; for programs without events

 public slots:
  void Refresh();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;

 private:
  void AddMenus();
  void AddJoints();
  void AddFrames();
  void AddKeyFrames(QWidget* box);
  void AddHints();
  void AddLook();
  void AddMotion();
  QAction* Add(class QMenu* menu, Action action);
  std::function<void()> InWindow(void (MainWindow::*act)());
  void Do(Action action);
  bool* Shown(Action action) const;
  void TakeAnswers();
  bool Try(const std::function<void()>& act);
  void Tell(const QString& text);
  void FindPictures();
  void ShowKeys();
  void Open();
  void WatchCamera();
  void NewPose();
  void AskExport();
  void AskExportMotion();
  void SayExported();
  void SaveScreenshot();
  void ShowPicture();
  void TakePicture();
  void SayReading();
  QImage Ground() const;
  void ShowJoints();
  void ShowProgress();
  void ShowHints();
  void AskHeight();

  const PhotoLifter& lifter_;
  KeyMap keys_;
  KeyRepeat repeat_;
  KeyPeek peek_;
  FramePictures pictures_;         // in the thread that reads alone
  BackgroundJob<QImage> reading_;  // the picture of the frame at hand
  std::map<Action, QAction*> actions_;
  PictureCanvas* picture_ = nullptr;
  PoseCanvas* pose_ = nullptr;
  QListWidget *joints_ = nullptr, *hints_ = nullptr;
  QSlider* frames_ = nullptr;
  Timeline* timeline_ = nullptr;
  KeyFramesBox* key_frames_ = nullptr;  // instead of slider and timeline of pictures
  MotionDock* motion_ = nullptr;
  Player* player_ = nullptr;
  std::vector<QDockWidget*> docks_;  // that may be hidden
  QDockWidget *joints_dock_ = nullptr, *frames_dock_ = nullptr;
  QLabel* status_ = nullptr;
  QLabel* cursor_ = nullptr;
  std::optional<size_t> shown_frame_;
  LabelSession session_;
};

}  // namespace poselift
