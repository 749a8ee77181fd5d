// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What is opened, found again, written, and saved at the end.
#include <QCloseEvent>
#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QProcess>
#include <QStatusBar>
#include <exception>
#include <filesystem>
#include <optional>

#include "lift/lifted_files.h"
#include "ui/window/camera_dialog.h"
#include "ui/window/main_window.h"
#include "ui/window/text_of.h"
#include "ui/window/welcome.h"

namespace poselift {
namespace {

constexpr int kLong_ms = 15000;  // a message stays

}  // namespace

// In a window of its own: what is at work here stays.
void MainWindow::Open() {
  QStringList arguments;
  for (const std::string& input : Welcome::AskForPictures(this))
    arguments << QString::fromStdString(input);
  if (!arguments.isEmpty())
    QProcess::startDetached(QCoreApplication::applicationFilePath(), arguments);
}

// Likewise; its stills are labelled there.
void MainWindow::WatchCamera() {
  const auto folder = session_.project().dir() / "live";
  const QStringList arguments =
      CameraDialog::AskForArguments(this, QString::fromStdString(folder.string()));
  if (!arguments.isEmpty())
    QProcess::startDetached(QCoreApplication::applicationFilePath(), arguments);
}

void MainWindow::NewPose() {
  QString file = QFileDialog::getSaveFileName(this, tr("A pose without a picture"),
                                              "pose.labels.json", tr("Labels (*.json)"), nullptr,
                                              QFileDialog::DontConfirmOverwrite);
  if (!file.isEmpty())
    QProcess::startDetached(QCoreApplication::applicationFilePath(), {"--pose", file});
}

void MainWindow::FindPictures() {
  const QString folder = QFileDialog::getExistingDirectory(this, tr("Where are the pictures?"));
  if (!folder.isEmpty()) FindPicturesIn(folder);
}

void MainWindow::FindPicturesIn(const QString& folder) {
  size_t count = 0;
  if (Try([&] { count = session_.Relink(folder.toStdString()); }))
    statusBar()->showMessage(tr("%n picture(s) found", "", static_cast<int>(count)), 5000);
  shown_frame_.reset();
  Refresh();
}

void MainWindow::AskExport() {
  const QString folder = QFileDialog::getExistingDirectory(this, tr("Export to a folder"));
  if (!folder.isEmpty()) ExportTo(folder);
}

void MainWindow::ExportTo(const QString& folder) {
  Try([&] { session_.Export(folder.toStdString()); });
  Refresh();
}

void MainWindow::AskExportMotion() {
  QStringList filters;
  for (const LiftedFormat& format : LiftedFormats())
    filters << QString("%1 (*%2)").arg(tr(format.name.data()), TextOf(format.ending));
  QString chosen = filters.front();
  QString file = QFileDialog::getSaveFileName(this, tr("Export the motion"), "motion",
                                              filters.join(";;"), &chosen);
  if (file.isEmpty()) return;
  const qsizetype index = filters.indexOf(chosen);
  if (QFileInfo(file).suffix().isEmpty() && index >= 0)
    file += TextOf(LiftedFormats()[static_cast<size_t>(index)].ending);
  ExportMotionTo(file);
}

void MainWindow::ExportMotionTo(const QString& file) {
  Try([&] { session_.ExportMotion(file.toStdString()); });
  Refresh();
}

void MainWindow::SayExported() {
  std::optional<std::filesystem::path> where;
  if (Try([&] { where = session_.TakeExported(); }) && !where) return;
  Refresh();
  if (where)
    statusBar()->showMessage(tr("exported to %1").arg(QString::fromStdString(where->string())),
                             kLong_ms);
}

void MainWindow::SaveScreenshot() {
  const QPixmap picture = grab();
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save screenshot"), "poselift.png", tr("PNG (*.png)"));
  if (!file.isEmpty() && !picture.save(file, "PNG"))
    QMessageBox::warning(this, tr("Not saved"), tr("%1 cannot be written").arg(file));
}

// Where saving fails nothing is lost but by will: the steps are in the journal, or said not to be.
void MainWindow::closeEvent(QCloseEvent* event) {
  try {
    if (!session_.project().read_only()) session_.Do(Action::kSave);
  } catch (const std::exception& error) {
    const auto answer = QMessageBox::warning(
        this, tr("Not saved"), tr("%1\n\nClose all the same?").arg(error.what()),
        QMessageBox::Close | QMessageBox::Cancel, QMessageBox::Cancel);
    if (answer != QMessageBox::Close) return event->ignore();
  }
  event->accept();
}

}  // namespace poselift
