// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/welcome.h"

#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QStandardPaths>
#include <QVBoxLayout>
#include <system_error>
#include <utility>

#include "lift/default_dictionary.h"
#include "src/input_error.h"
#include "ui/window/camera_dialog.h"

namespace poselift {

namespace fs = std::filesystem;

Welcome::Welcome(fs::path sample, QWidget* parent, ListFn cameras)
    : QDialog(parent), sample_(std::move(sample)), cameras_(std::move(cameras)) {
  setObjectName("welcome");
  setWindowTitle(tr("poselift"));
  auto* const column = new QVBoxLayout(this);
  auto* const text = new QLabel(
      tr("<h3>A picture, fifteen clicks, a 3D skeleton</h3>"
         "<p>Click the joints in the order in which they are asked for: the pose answers after "
         "each.<br>Drag any joint to set it right; the right button says that one is hidden.</p>"
         "<p>F1 shows all keys.</p>"),
      this);
  text->setObjectName("welcome_text");
  column->addWidget(text);
  const auto add = [&](const char* name, const QString& title) {
    auto* const button = new QPushButton(title, this);
    button->setObjectName(name);
    button->setAccessibleName(title);
    column->addWidget(button);
    return button;
  };
  connect(add("open", tr("&Open pictures or labels...")), &QPushButton::clicked, this, [this] {
    inputs_ = AskForPictures(this);
    if (!inputs_.empty()) accept();
  });
  connect(add("camera", tr("&Camera...")), &QPushButton::clicked, this, &Welcome::ChooseCamera);
  if (!sample_.empty())
    connect(add("try_sample", tr("&Try it with the sample picture")), &QPushButton::clicked, this,
            &Welcome::TrySample);
}

std::vector<std::string> Welcome::AskForPictures(QWidget* parent) {
  const QStringList files =
      QFileDialog::getOpenFileNames(parent, tr("Pictures or a labels file"), {},
                                    tr("Pictures and labels (*.jpg *.jpeg *.png *.tif *.tiff "
                                       "*.webp *.bmp *.mp4 *.mov *.avi *.mkv *.webm "
                                       "*.json);;All (*)"));
  std::vector<std::string> inputs;
  for (const QString& file : files) inputs.push_back(file.toStdString());
  return inputs;
}

void Welcome::ChooseCamera() {
  CameraDialog dialog(cameras_(), this);
  if (dialog.exec() != QDialog::Accepted) return;
  inputs_ = {dialog.device()};
  tags_file_ = dialog.tags_file();
  camera_file_ = dialog.camera_file();
  accept();
}

void Welcome::TrySample() {
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  try {
    inputs_ = {CopyOfSample(sample_, fs::path(documents.toStdString()) / "poselift").string()};
    accept();
  } catch (const InputError& error) {
    QMessageBox::warning(this, tr("No sample"), error.what());
  }
}

fs::path SamplePicture() {
  std::error_code ignored;
  const fs::path models = fs::path(DefaultDictionaryPath()).parent_path();
  for (const char* place : {"samples/kick.jpg", "../samples/photo/kick.jpg"})
    if (fs::is_regular_file(models / place, ignored)) return models / place;
  return {};
}

fs::path CopyOfSample(const fs::path& sample, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path copy = folder / sample.filename();
  if (!error && !fs::exists(copy)) fs::copy_file(sample, copy, error);
  if (error) throw InputError(folder, "the sample cannot be copied there: " + error.message());
  return copy;
}

}  // namespace poselift
