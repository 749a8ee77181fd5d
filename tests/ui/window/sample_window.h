// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <gtest/gtest.h>

#include <QAction>
#include <QListWidget>
#include <QMessageBox>
#include <QMouseEvent>
#include <QSlider>
#include <QStatusBar>
#include <QTest>
#include <filesystem>
#include <memory>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "src/io/labels.h"
#include "tests/support/support.h"
#include "ui/label/label_inputs.h"
#include "ui/window/main_window.h"
#include "ui/window/picture_canvas.h"
#include "ui/window/pose_canvas.h"

namespace poselift::testing {

namespace fs = std::filesystem;

// The mouse over a widget without a button, on screens of any scale: QTest::mouseMove gives no
// event where the mouse is already, as the system counts.
inline void HoverOver(QWidget* widget, const QPoint& at) {
  QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, Qt::NoButton,
                   Qt::NoModifier);
  QCoreApplication::sendEvent(widget, &move);
}

// A window on the sample picture of a kick, without labels, and the labels it is to get.
class SampleWindow : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = ScratchDir();
    const fs::path samples = SourcePath("samples/photo");
    OpenOn(samples / "kick.jpg", ReadLabels(samples / "kick.labels.json"));
  }

  // On a copy of a picture without labels, to be labelled as these are.
  void OpenOn(const fs::path& picture, const Labels& labels) {
    copy_ = folder_ / picture.filename();
    fs::copy_file(picture, copy_, fs::copy_options::overwrite_existing);
    const std::string file = picture.stem().string() + ".labels.json";
    for (const std::string& left : {file, "." + file + ".journal"}) fs::remove(folder_ / left);
    person_ = labels.frames[0].people[0];
    layout_ = labels.layout;
    Open();
  }

  void Open() {
    window_.reset();
    project_.reset();
    file_ = FindLabelsFile({copy_.string()}, "", layout_);
    project_ = std::make_unique<LabelProject>(file_);
    window_ = std::make_unique<MainWindow>(project_.get(), lifter_, KeyMap());
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    window_->WaitForPicture();
    picture_ = window_->findChild<PictureCanvas*>("picture");
  }

  QPoint At(const LandmarkLabel& label) const {
    const Eigen::Vector2d x = picture_->view().ToWidget(label.x_px);
    return QPointF(x.x(), x.y()).toPoint();
  }
  const LandmarkLabel& Label(std::string_view name) const {
    return *LabelSession::Find(person_, name);
  }
  // In the layout's order, as the window asks for them.
  void ClickAll() {
    for (const Landmark& landmark : FindLayout(layout_)->landmarks)
      QTest::mouseClick(picture_, Qt::LeftButton, {}, At(Label(landmark.name)));
  }
  const std::vector<LandmarkLabel>& Landmarks() const {
    return project_->labels().frames[0].people.at(0).landmarks;
  }

  Dictionary dictionary_ = ReadDictionary(DefaultDictionaryPath());
  PhotoLifter lifter_{dictionary_};
  PersonLabels person_;
  fs::path folder_, copy_, file_;
  std::string layout_;
  std::unique_ptr<LabelProject> project_;
  std::unique_ptr<MainWindow> window_;
  PictureCanvas* picture_ = nullptr;
};

}  // namespace poselift::testing
