// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Pictures of the window's main states, for people to look at: into the folder that
// POSELIFT_SCREENSHOTS names, from where they go to docs/, else into the tests' own. Checked: that
// each state shows something that the one before does not.
#include <gtest/gtest.h>

#include <QApplication>
#include <QCursor>
#include <QPalette>
#include <QTest>
#include <cstdlib>

#include "tests/support/walk_labels.h"
#include "tests/ui/window/sample_window.h"
#include "ui/window/welcome.h"

namespace poselift {
namespace {

class Screenshots : public testing::SampleWindow {
 protected:
  void Take(const std::string& name) { Take(name, window_.get()); }
  void Take(const std::string& name, QWidget* widget) {
    QTest::qWait(50);
    const QImage picture = widget->grab().toImage();
    EXPECT_NE(picture, last_) << name;
    last_ = picture;
    const char* const folder = std::getenv("POSELIFT_SCREENSHOTS");
    const auto file = (folder ? testing::fs::path(folder) : folder_) / (name + ".jpg");
    ASSERT_TRUE(picture.save(QString::fromStdString(file.string()), "JPG", 88)) << file;
  }

  QImage last_;
};

TEST_F(Screenshots, AreTaken) {
  Welcome welcome(SamplePicture());
  welcome.show();
  Take("label-welcome", &welcome);
  welcome.close();
  window_->activateWindow();
  Take("label-empty");
  ClickAll();
  window_->session().WaitUntilSolved();
  window_->Refresh();
  Take("label-solved");
  auto* const pose = window_->findChild<PoseCanvas*>("pose");
  QTest::mousePress(pose, Qt::LeftButton, {}, {60, 60});
  QTest::mouseMove(pose, {160, 90});
  QTest::mouseRelease(pose, Qt::LeftButton, {}, {160, 90});
  Take("label-turned");
  QTest::keyClick(window_.get(), Qt::Key_P);
  Take("label-alternative");
  window_->session().GoToLandmark(*FindLayout("body15")->Find("right_knee"));
  window_->findChild<QAction*>("flip_limb")->trigger();
  window_->session().WaitUntilSolved();
  window_->Refresh();
  Take("label-flipped");
  QTest::keyClick(window_.get(), Qt::Key_Q);
  QTest::mouseMove(picture_, At(Label("right_knee")));
  Take("label-loupe");
  window_->findChild<QWidget*>("look_dock")->show();
  window_->findChild<QSlider*>("gamma")->setValue(40);
  Take("label-look");
  window_->findChild<QWidget*>("look_dock")->hide();
  const QPalette light = QApplication::palette();
  QPalette dark(QColor(53, 53, 53));
  dark.setColor(QPalette::Base, QColor(35, 35, 35));
  QApplication::setPalette(dark);
  Take("label-dark");
  QApplication::setPalette(light);
}

// With its video where the real data is.
TEST_F(Screenshots, OfAMotion) {
  LabelProject walk(testing::FreshLabelsFile(folder_, testing::ShortWalk(80, 30)));
  if (const auto data = testing::DataDir()) walk.Relink(*data / "photos");
  MainWindow window(&walk, lifter_, KeyMap());
  window.resize(1400, 900);
  window.show();
  window.findChild<QAction*>("smooth_motion")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.session().motion() != nullptr; }, 60000));
  auto* const angles = window.findChild<QListWidget*>("angles");
  for (const QString name : {"left_hip.flexion", "left_elbow.flexion"})
    angles->findItems(name, Qt::MatchExactly).front()->setCheckState(Qt::Checked);
  window.session().GoToFrame(52);
  window.session().WaitUntilSolved();
  window.Refresh();
  Take("label-motion", &window);
}

}  // namespace
}  // namespace poselift
