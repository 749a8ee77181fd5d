// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QDialog>
#include <QStringList>
#include <string>
#include <vector>

#include "src/capture/camera_list.h"

class QFormLayout;
class QLineEdit;
class QListWidget;

namespace poselift {

// Which camera, and with which files: the tags that somebody wears, the camera as it was
// calibrated.
class CameraDialog : public QDialog {
  Q_OBJECT

 public:
  explicit CameraDialog(const std::vector<CameraInfo>& cameras, QWidget* parent = nullptr);

  // What poselift-label is to be started with to watch a camera of this machine, its stills and
  // recordings in that folder; empty when none was chosen.
  static QStringList AskForArguments(QWidget* parent, const QString& folder);

  std::string device() const;  // empty when there is none
  std::string tags_file() const;
  std::string camera_file() const;

 private:
  QLineEdit* AddFile(QFormLayout* rows, const char* name, const QString& title,
                     const QString& filter);

  std::vector<std::string> devices_;
  QListWidget* list_ = nullptr;
  QLineEdit *tags_ = nullptr, *camera_ = nullptr;
};

}  // namespace poselift
