// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: a part of the labels of a walk, the dictionary and the motion codebook that ship, mouse and
// key events of Qt on its platform without a screen. Checked: a key makes the motion, the plot
// shows it, leads to frames and says what is out of date; playing goes on to the last frame and
// stops. Not there: the video; its frames are shown without a picture.
#include "ui/window/motion_dock.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTest>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "src/io/image.h"
#include "src/joint_angles.h"
#include "tests/support/support.h"
#include "tests/support/walk_labels.h"
#include "ui/window/angle_plot_widget.h"
#include "ui/window/main_window.h"
#include "ui/window/player.h"
#include "ui/window/pose_canvas.h"

namespace poselift {
namespace {

class MotionDockTest : public ::testing::Test {
 protected:
  void Open(int num_frames) {
    const auto folder = testing::ScratchDir();
    Labels walk = testing::ShortWalk(num_frames, num_frames / 2);
    const cv::Size size_px(walk.frames[0].width_px, walk.frames[0].height_px);
    WritePng(folder / "paper.png", cv::Mat(size_px, CV_8UC3, cv::Scalar::all(200)));
    for (FrameLabels& frame : walk.frames) {
      frame.image = "paper.png";
      frame.frame.reset();
    }
    project_ = std::make_unique<LabelProject>(testing::FreshLabelsFile(folder, walk));
    window_ = std::make_unique<MainWindow>(project_.get(), lifter_, KeyMap());
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    window_->WaitForPicture();
    plot_ = window_->findChild<AnglePlotWidget*>("angle_plot");
    EXPECT_FALSE(plot_->isVisible());
    window_->findChild<MotionDock*>()->show();
    ASSERT_TRUE(plot_->isVisible());
  }
  LabelSession& session() { return window_->session(); }
  void Smooth() {
    QTest::keyClick(window_.get(), Qt::Key_M);
    ASSERT_TRUE(QTest::qWaitFor([&] { return session().motion() != nullptr; }, 60000));
    ASSERT_TRUE(session().motion()->HasPoses()) << session().motion()->message;
  }
  template <class Widget>
  Widget* Child(const char* name) {
    return window_->findChild<Widget*>(name);
  }
  QImage Look(QWidget* widget) { return widget->grab().toImage(); }

  Dictionary dictionary_ = ReadDictionary(DefaultDictionaryPath());
  PhotoLifter lifter_{dictionary_};
  std::unique_ptr<LabelProject> project_;
  std::unique_ptr<MainWindow> window_;
  AnglePlotWidget* plot_ = nullptr;
};

TEST_F(MotionDockTest, AKeySmoothsAndThePlotLeadsToFrames) {
  Open(14);
  const QImage empty = Look(plot_);
  Smooth();
  const QImage with_curves = Look(plot_);
  EXPECT_NE(with_curves, empty);
  EXPECT_FALSE(Child<QProgressBar>("motion_progress")->isVisible());
  EXPECT_TRUE(Child<QLabel>("motion_text")->text().contains("3 filled"));
  QTest::mouseClick(plot_, Qt::LeftButton, {}, {plot_->width() - 275, 40});
  EXPECT_EQ(session().frame_index(), 13U);
  const QImage at_end = Look(plot_);
  EXPECT_NE(at_end, with_curves);  // the cursor and the values
  QTest::mousePress(plot_, Qt::LeftButton, {}, {plot_->width() - 275, 40});
  QTest::mouseMove(plot_, {53, 40});
  QTest::mouseRelease(plot_, Qt::LeftButton, {}, {53, 40});
  EXPECT_EQ(session().frame_index(), 0U);
  auto* const angles = Child<QListWidget>("angles");
  ASSERT_EQ(angles->count(), static_cast<int>(JointAngles().size()));
  const QImage two = Look(plot_);
  angles->item(0)->setCheckState(Qt::Checked);
  EXPECT_NE(Look(plot_), two);
}

TEST_F(MotionDockTest, ComesWhenSomebodyAsksForAMotion) {
  Open(12);
  window_->findChild<MotionDock*>()->hide();
  QTest::keyClick(window_.get(), Qt::Key_M);
  EXPECT_TRUE(plot_->isVisible());
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_FALSE(session().MotionProgress());
}

TEST_F(MotionDockTest, BothViewsShowTheMotionWhileThatIsOn) {
  Open(12);
  Smooth();
  session().WaitUntilSolved();
  window_->Refresh();
  auto* const pose = Child<PoseCanvas>("pose");
  auto* const picture = Child<QWidget>("picture");
  const QImage motion = Look(pose), overlay = Look(picture);
  QTest::keyClick(window_.get(), Qt::Key_K, Qt::ShiftModifier);
  EXPECT_FALSE(Child<QCheckBox>("shows_motion")->isChecked());
  EXPECT_NE(Look(pose), motion);
  EXPECT_NE(Look(picture), overlay);
  Child<QCheckBox>("shows_motion")->click();
  EXPECT_EQ(Look(pose), motion);
}

TEST_F(MotionDockTest, WhatIsOutOfDateIsSaidAndCanBeMadeAnew) {
  Open(12);
  Smooth();
  const QImage current = Look(plot_), timeline = Look(Child<QWidget>("timeline"));
  session().GoToLandmark(3);
  window_->findChild<QAction*>("nudge_left")->trigger();
  EXPECT_TRUE(Child<QLabel>("motion_text")->text().contains("OUT OF DATE"));
  EXPECT_NE(Look(plot_), current);
  EXPECT_NE(Look(Child<QWidget>("timeline")), timeline);
  QTest::mouseClick(Child<QPushButton>("smooth"), Qt::LeftButton);
  EXPECT_TRUE(Child<QProgressBar>("motion_progress")->isVisibleTo(window_.get()));
  ASSERT_TRUE(QTest::qWaitFor([&] { return session().IsMotionCurrent(); }, 60000));
  EXPECT_FALSE(Child<QLabel>("motion_text")->text().contains("OUT OF DATE"));
}

TEST_F(MotionDockTest, TheButtonCancelsWhatRuns) {
  Open(60);
  auto* const button = Child<QPushButton>("smooth");
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(button->text(), "Cancel");
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(button->text(), "Smooth motion");
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(button->text(), "Cancel");
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_EQ(button->text(), "Smooth motion");
  EXPECT_EQ(session().motion(), nullptr);
}

TEST_F(MotionDockTest, PlayingGoesOnToTheLastFrameAndStops) {
  Open(12);
  auto* const player = window_->findChild<Player*>();
  QSignalSpy frames(player, &Player::FrameDue);
  QTest::keyClick(window_.get(), Qt::Key_K);
  EXPECT_TRUE(player->is_playing());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !player->is_playing(); }, 60000));
  EXPECT_EQ(session().frame_index(), 11U);
  int before = 0;
  for (const QList<QVariant>& frame : frames) {
    EXPECT_GT(frame[0].toInt(), before);
    before = frame[0].toInt();
  }
  EXPECT_EQ(before, 11);
  QTest::keyClick(window_.get(), Qt::Key_K);  // at the end: from the beginning
  EXPECT_TRUE(player->is_playing());
  QTest::keyClick(window_.get(), Qt::Key_K);
  EXPECT_FALSE(player->is_playing());
}

TEST_F(MotionDockTest, WhoGoesToAFrameStopsPlaying) {
  Open(60);
  auto* const player = window_->findChild<Player*>();
  QTest::keyClick(window_.get(), Qt::Key_K);
  ASSERT_TRUE(QTest::qWaitFor([&] { return session().frame_index() > 0; }, 60000));
  QTest::keyClick(window_.get(), Qt::Key_Home);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !player->is_playing(); }, 60000));
  EXPECT_EQ(session().frame_index(), 0U);
}

TEST_F(MotionDockTest, NoFrameIsDueWhileTheOneBeforeIsNotThere) {
  Open(6);
  bool is_late = true;
  Player player(
      &session(), [&] { return is_late; }, nullptr);
  QSignalSpy frames(&player, &Player::FrameDue);
  QObject::connect(&player, &Player::FrameDue,
                   [&](int frame) { session().PlayTo(static_cast<size_t>(frame)); });
  player.Toggle();
  QTest::qWait(300);  // longer than the frames take
  EXPECT_EQ(frames.count(), 0);
  EXPECT_TRUE(player.is_playing());
  is_late = false;
  ASSERT_TRUE(QTest::qWaitFor([&] { return !player.is_playing(); }, 60000));
  EXPECT_EQ(session().frame_index(), 5U);
}

TEST_F(MotionDockTest, TheMotionIsExportedOrTheReasonSaid) {
  Open(12);
  const auto file = testing::ScratchDir() / "walk.bvh";
  window_->ExportMotionTo(QString::fromStdString(file.string()));
  EXPECT_FALSE(std::filesystem::exists(file));
  auto* const message = window_->findChild<QWidget*>("message");
  ASSERT_NE(message, nullptr);
  message->close();
  Smooth();
  window_->ExportMotionTo(QString::fromStdString(file.string()));
  session().WaitUntilExported();
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST_F(MotionDockTest, AnExportGoesOnWhileTheWindowIsWorkedIn) {
  Open(30);
  const auto folder = testing::ScratchDir() / "window";
  std::filesystem::remove_all(folder);
  window_->ExportTo(QString::fromStdString(folder.string()));
  EXPECT_TRUE(Child<QLabel>("status")->text().contains("exporting"));
  EXPECT_FALSE(std::filesystem::exists(folder / "poses.json"));
  QTest::keyClick(window_.get(), Qt::Key_Delete);
  EXPECT_TRUE(project_->history().CanUndo());
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->statusBar()->currentMessage().contains("exported to"); }, 60000));
  EXPECT_TRUE(Child<QLabel>("status")->text().contains("exported to"));
  EXPECT_TRUE(std::filesystem::exists(folder / "poses.bvh"));
}

TEST_F(MotionDockTest, AnExportIsStoppedByAKeyAndEndsWithTheWindow) {
  Open(60);
  const auto folder = testing::ScratchDir() / "window";
  std::filesystem::remove_all(folder);
  window_->ExportTo(QString::fromStdString(folder.string()));
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_TRUE(Child<QLabel>("status")->text().contains("stopped"));
  session().WaitUntilExported();
  window_->ExportTo(QString::fromStdString(folder.string()));
  EXPECT_TRUE(window_->close());
  window_.reset();
  EXPECT_FALSE(std::filesystem::exists(folder / "poses.json"));
}

}  // namespace
}  // namespace poselift
