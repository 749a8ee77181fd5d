// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/camera_dialog.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>

namespace poselift {

CameraDialog::CameraDialog(const std::vector<CameraInfo>& cameras, QWidget* parent)
    : QDialog(parent) {
  setObjectName("camera_dialog");
  setWindowTitle(tr("Camera"));
  auto* const rows = new QFormLayout(this);
  auto* const buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  if (cameras.empty()) {
    auto* const none = new QLabel(tr("No camera was found. Plug one in and come back here; "
                                     "`poselift doctor` tells more."),
                                  this);
    none->setObjectName("no_camera");
    rows->addRow(none);
    rows->addRow(buttons);
    return;
  }
  list_ = new QListWidget(this);
  list_->setObjectName("cameras");
  list_->setAccessibleName(tr("Cameras"));
  for (const CameraInfo& camera : cameras) {
    devices_.push_back(camera.path);
    const std::string& text = camera.problem.empty() ? camera.name : camera.problem;
    list_->addItem(QString::fromStdString(text + " (" + camera.path + ")"));
  }
  list_->setCurrentRow(0);
  rows->addRow(list_);
  tags_ = AddFile(rows, "tags_file", tr("Tags that somebody wears"), tr("Tags (*.toml)"));
  camera_ = AddFile(rows, "camera_file", tr("Camera, calibrated"),
                    tr("Cameras (*.yaml *.yml *.toml *.json);;All (*)"));
  buttons->addButton(QDialogButtonBox::Ok)->setObjectName("watch");
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(list_, &QListWidget::itemActivated, this, &QDialog::accept);
  rows->addRow(buttons);
}

// May stay empty.
QLineEdit* CameraDialog::AddFile(QFormLayout* rows, const char* name, const QString& title,
                                 const QString& filter) {
  auto* const row = new QHBoxLayout;
  auto* const file = new QLineEdit(this);
  file->setObjectName(name);
  file->setAccessibleName(title);
  file->setPlaceholderText(tr("none"));
  auto* const browse = new QPushButton(tr("Choose..."), this);
  browse->setObjectName(QString("choose_") + name);
  browse->setAccessibleName(tr("Choose: %1").arg(title));
  row->addWidget(file);
  row->addWidget(browse);
  rows->addRow(title, row);
  connect(browse, &QPushButton::clicked, this, [this, file, title, filter] {
    const QString chosen = QFileDialog::getOpenFileName(this, title, {}, filter);
    if (!chosen.isEmpty()) file->setText(chosen);
  });
  return file;
}

QStringList CameraDialog::AskForArguments(QWidget* parent, const QString& folder) {
  CameraDialog dialog(ListCameras(), parent);
  if (dialog.exec() != QDialog::Accepted) return {};
  QStringList arguments{QString::fromStdString(dialog.device()), "--out", folder};
  if (!dialog.tags_->text().isEmpty()) arguments << "--tags" << dialog.tags_->text();
  if (!dialog.camera_->text().isEmpty()) arguments << "--camera" << dialog.camera_->text();
  return arguments;
}

std::string CameraDialog::device() const {
  return list_ && list_->currentRow() >= 0 ? devices_[static_cast<size_t>(list_->currentRow())]
                                           : std::string();
}

std::string CameraDialog::tags_file() const { return tags_ ? tags_->text().toStdString() : ""; }

std::string CameraDialog::camera_file() const {
  return camera_ ? camera_->text().toStdString() : "";
}

}  // namespace poselift
