// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QMainWindow>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "ui/label/key_map.h"
#include "ui/label/still_folder.h"
#include "ui/live/live_session.h"

class QAction;
class QLabel;

namespace poselift {

class LiveCanvas;
class LivePoseCanvas;
class MainWindow;

// A camera that is watched: its picture with tags and skeleton, the pose in space, how it goes. A
// frame that is frozen is labelled in a window beside it (MainWindow); a recording goes on
// meanwhile. An error of the camera is told here, and the camera may be tried again.
class LiveWindow : public QMainWindow {
  Q_OBJECT

 public:
  struct Options {
    std::string name;              // of the camera, for people
    std::filesystem::path folder;  // of stills, their labels, and recordings
    std::string layout = "body15";
  };
  // open: see LiveSession. lifter must outlive the window.
  LiveWindow(std::function<LiveParts()> open, const Options& options, const PhotoLifter& lifter,
             const KeyMap& keys);
  ~LiveWindow() override;

  void SetFolder(const std::filesystem::path& folder);
  const LiveStatus& status() const { return status_; }
  MainWindow* labels() { return labels_.get(); }  // null before the first still

 public slots:
  void Freeze();
  void ToggleRecording();
  void Restart();  // after an error, or the end of a video

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  QAction* Add(Action action, const QString& text, void (LiveWindow::*act)());
  void ShowKeys();
  void Refresh();
  void ShowProblem(const QString& text);
  void ShowState();
  void AskFolder();
  bool CloseLabels();

  const std::function<LiveParts()> open_;
  const Options options_;
  const PhotoLifter& lifter_;
  const KeyMap keys_;

  LiveCanvas* picture_ = nullptr;
  LivePoseCanvas* pose_ = nullptr;
  QLabel *line_ = nullptr, *problem_ = nullptr, *folder_line_ = nullptr;
  QAction *freeze_ = nullptr, *record_ = nullptr, *restart_ = nullptr, *folder_ = nullptr;

  LiveStatus status_;
  bool wants_recording_ = false;
  StillFolder stills_;
  std::unique_ptr<MainWindow> labels_;    // before stills_ goes
  std::unique_ptr<LiveSession> session_;  // the last member: its thread tells this window
};

}  // namespace poselift
