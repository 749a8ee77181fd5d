// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// With a translation that puts every text between « and »: in no window is there a text, a tip or a
// name for screen readers left that it does not know, but for names of files and of angles, which
// are the columns of angles.csv.
#include "ui/window/language.h"

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QComboBox>
#include <QCoreApplication>
#include <QDockWidget>
#include <QGroupBox>
#include <QLabel>
#include <QRegularExpression>
#include <QTranslator>

#include "src/translated.h"
#include "tests/ui/window/sample_window.h"
#include "ui/label/new_pose.h"
#include "ui/live/live_inputs.h"
#include "ui/window/camera_dialog.h"
#include "ui/window/live_window.h"
#include "ui/window/welcome.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

class Quoting : public QTranslator {
 public:
  bool isEmpty() const override { return false; }
  QString translate(const char* /*context*/, const char* english, const char*, int) const override {
    return QString("«%1»").arg(english);
  }
};

class LanguageTest : public testing::SampleWindow {
 protected:
  void SetUp() override {
    QCoreApplication::installTranslator(&quoting_);
    SpeakLanguageOf(QLocale::c());
    SampleWindow::SetUp();
  }
  void TearDown() override {
    QCoreApplication::removeTranslator(&quoting_);
    TranslateBy({});
  }

  // Words outside of all quotes.
  static void Check(const QString& text, const QObject& where) {
    const QRegularExpression quoted("«[^«»]*»"), tag("<[^>]*>"),
        file(R"([\w/.…-]+\.(jpg|json|mp4)|[\w.…-]*/[\w/.-]+)"), word("[A-Za-z]{3,}");
    QString left = text;
    left.remove(tag).remove(file);
    for (QString before; before != left; left.remove(quoted)) before = left;
    left.remove("poselift");
    EXPECT_FALSE(left.contains(word))
        << where.metaObject()->className() << " " << where.objectName().toStdString() << ": "
        << text.toStdString();
  }
  static void CheckAll(QWidget* window) {
    for (QAction* const action : window->findChildren<QAction*>()) {
      Check(action->text(), *action);
      Check(action->toolTip(), *action);
    }
    QList<QWidget*> widgets = window->findChildren<QWidget*>();
    widgets << window;
    for (QWidget* const widget : widgets) {
      for (const QString& text :
           {widget->windowTitle(), widget->toolTip(), widget->accessibleName()})
        Check(text, *widget);
      if (const auto* const label = qobject_cast<QLabel*>(widget)) Check(label->text(), *widget);
      if (const auto* const button = qobject_cast<QAbstractButton*>(widget))
        Check(button->text(), *widget);
      if (const auto* const box = qobject_cast<QGroupBox*>(widget)) Check(box->title(), *widget);
      if (const auto* const box = qobject_cast<QComboBox*>(widget))
        for (int i = 0; i < box->count(); ++i) Check(box->itemText(i), *widget);
      if (const auto* const list = qobject_cast<QListWidget*>(widget);
          list && list->objectName() != "angles")
        for (int i = 0; i < list->count(); ++i) Check(list->item(i)->text(), *widget);
    }
  }
  void CheckWindow() {
    window_->session().WaitUntilSolved();
    window_->Refresh();
    CheckAll(window_.get());
  }

  Quoting quoting_;
};

TEST_F(LanguageTest, OfTheWindowIsTheDesktops) {
  CheckWindow();
  ClickAll();
  CheckWindow();
  LabelSession& session = window_->session();
  for (const Action action : {Action::kNextPose, Action::kFlipLimb, Action::kCycleState,
                              Action::kNearer, Action::kOnFloor, Action::kSmoothMotion}) {
    session.Do(action);
    session.WaitUntilSmoothed();
    CheckWindow();
  }
  session.Hover(2);
  CheckWindow();
}

TEST_F(LanguageTest, OfKeyFramesToo) {
  const fs::path file = folder_ / "hero.labels.json";
  for (const char* left : {"hero.labels.json", ".hero.labels.json.journal"})
    fs::remove(folder_ / left);
  CreatePoseFile(file, "body15", dictionary_.skeleton);
  window_.reset();
  project_ = std::make_unique<LabelProject>(file);
  window_ = std::make_unique<MainWindow>(project_.get(), lifter_, KeyMap());
  window_->session().Do(Action::kAddKeyFrame);
  window_->session().WaitUntilSmoothed();
  CheckWindow();
  window_->session().Do(Action::kStepBack);
  CheckWindow();
}

TEST_F(LanguageTest, OfDialogsAndTheCamerasWindow) {
  Welcome welcome(SamplePicture());
  CheckAll(&welcome);
  CameraDialog cameras({});
  CheckAll(&cameras);
  LiveInputs inputs;
  inputs.view.input = testing::SourcePath("samples/tags/clip.mp4");
  inputs.view.camera = testing::SourcePath("samples/tags/camera.yaml");
  inputs.tags = testing::SourcePath("samples/tags/tags.toml");
  LiveWindow live([&] { return OpenLive(inputs, lifter_); }, {"clip.mp4", folder_ / "live"},
                  lifter_, KeyMap());
  live.show();
  constexpr int kPatience_ms = 120000;
  ASSERT_TRUE(QTest::qWaitFor([&] { return live.status().num_pictures > 2; }, kPatience_ms));
  CheckAll(&live);
}

}  // namespace
}  // namespace poselift
