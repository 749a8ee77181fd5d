// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sample picture of a kick, its labels, the dictionary that ships, mouse and key events
// of Qt on its platform without a screen. Checked: a person who clicks the joints gets what the
// program lifts from the same labels; keys, undo, and what is there after a restart.
#include "ui/window/main_window.h"

#include <gtest/gtest.h>

#include "tests/support/made_up_video.h"
#include "tests/support/mutation.h"
#include "tests/support/run_program.h"
#include "tests/ui/window/sample_window.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

using testing::FileText;
using testing::RunProgram;

using MainWindowTest = testing::SampleWindow;

TEST_F(MainWindowTest, FifteenClicksLiftTheSampleAsTheProgramDoes) {
  ClickAll();
  ASSERT_EQ(Landmarks().size(), 15U);
  for (const LandmarkLabel& label : Landmarks()) {
    // The mouse has whole pixels of the screen.
    EXPECT_LT((label.x_px - Label(label.name).x_px).norm(), 0.8 / picture_->view().scale());
    if (Label(label.name).state == LabelState::kOccluded)
      QTest::mouseClick(picture_, Qt::RightButton, {}, At(label));
  }
  window_->session().WaitUntilSolved();
  ASSERT_NE(window_->session().pose(), nullptr);
  EXPECT_LT(window_->session().pose()->reprojection_rms_px, 8.0);
  QTest::keyClick(window_.get(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(project_->IsSaved());
  window_->ExportTo(QString::fromStdString((folder_ / "window").string()));
  window_->session().WaitUntilExported();
  const auto run = RunProgram("lift " + (folder_ / "kick.jpg").string() + " --out " +
                              (folder_ / "program").string());
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* name : {"poses.bvh", "angles.csv", "poses.json"})
    EXPECT_EQ(FileText(folder_ / "window" / name), FileText(folder_ / "program" / name)) << name;
}

// A real photo, labelled end to end: joints are chosen in the list, hidden ones said to be so.
TEST_F(MainWindowTest, TheSkierIsLabelledAndExportedAsTheProgramLiftsIt) {
  POSELIFT_DATA_OR_SKIP(data);
  OpenOn(data / "photos/skier.jpg", ReadLabels(data / "photos/skier.coco.json"));
  auto* const joints = window_->findChild<QListWidget*>("joints");
  int num_placed = 0;
  for (const LandmarkLabel& label : person_.landmarks) {
    if (label.state == LabelState::kAbsent) continue;
    joints->setCurrentRow(*FindLayout(layout_)->Find(label.name));
    QTest::mouseClick(picture_, Qt::LeftButton, {}, At(label));
    if (label.state == LabelState::kOccluded)
      QTest::mouseClick(picture_, Qt::RightButton, {}, At(label));
    ++num_placed;
  }
  EXPECT_EQ(std::ssize(Landmarks()), num_placed);
  window_->session().WaitUntilSolved();
  ASSERT_NE(window_->session().pose(), nullptr);
  QTest::keyClick(window_.get(), Qt::Key_S, Qt::ControlModifier);
  window_->ExportTo(QString::fromStdString((folder_ / "window").string()));
  window_->session().WaitUntilExported();
  const auto run =
      RunProgram("lift " + copy_.string() + " --out " + (folder_ / "program").string());
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(FileText(folder_ / "window/poses.bvh"), FileText(folder_ / "program/poses.bvh"));
}

TEST_F(MainWindowTest, ADragMovesAJointAndUndoTakesItBack) {
  ClickAll();
  const Eigen::Vector2d before_px =
      LabelSession::Find(project_->labels().frames[0].people[0], "left_knee")->x_px;
  const QPoint from = At(Label("left_knee")), to = from + QPoint(40, -25);
  QTest::mousePress(picture_, Qt::LeftButton, {}, from);
  QTest::mouseMove(picture_, to);
  QTest::mouseRelease(picture_, Qt::LeftButton, {}, to);
  const auto knee_px = [&] {
    return LabelSession::Find(project_->labels().frames[0].people[0], "left_knee")->x_px;
  };
  const Eigen::Vector2d by_px = Eigen::Vector2d(40, -25) / picture_->view().scale();
  EXPECT_LT((knee_px() - before_px - by_px).norm(), 1.0 / picture_->view().scale());
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(knee_px(), before_px);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_NE(knee_px(), before_px);
}

TEST_F(MainWindowTest, WhatWasClickedIsThereAfterARestartAndCanBeUndone) {
  QTest::mouseClick(picture_, Qt::LeftButton, {}, At(Label("pelvis")));
  QTest::mouseClick(picture_, Qt::LeftButton, {}, At(Label("neck")));
  Open();
  ASSERT_EQ(Landmarks().size(), 2U);
  EXPECT_EQ(window_->session().landmark(), *FindLayout("body15")->Find("head_top"));
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(Landmarks().size(), 1U);
}

TEST_F(MainWindowTest, TheWheelKeepsThePointUnderTheCursor) {
  const QPoint cursor(300, 200);
  const Eigen::Vector2d before_px = picture_->view().ToPicture({300.0, 200.0});
  const double scale = picture_->view().scale();
  QWheelEvent wheel(cursor, picture_->mapToGlobal(cursor), {}, {0, 240}, Qt::NoButton, {},
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(picture_, &wheel);
  EXPECT_GT(picture_->view().scale(), 1.2 * scale);
  EXPECT_TRUE(testing::MatrixNear(picture_->view().ToPicture({300.0, 200.0}), before_px, 1e-9));
}

TEST_F(MainWindowTest, AKeyThatIsHeldHidesTheLabelsUntilItIsLetGo) {
  constexpr int kHeld_ms = 450;
  QTest::keyPress(picture_, Qt::Key_L);
  EXPECT_FALSE(picture_->shows_labels);
  QTest::qWait(kHeld_ms);
  QTest::keyRelease(picture_, Qt::Key_L);
  EXPECT_TRUE(picture_->shows_labels);
}

TEST_F(MainWindowTest, EveryWidgetThatTakesTheFocusHasANameForReaders) {
  for (const QWidget* widget : window_->findChildren<QWidget*>()) {
    if (!widget->isVisibleTo(window_.get()) || !(widget->focusPolicy() & Qt::TabFocus)) continue;
    EXPECT_FALSE(widget->objectName().isEmpty()) << widget->metaObject()->className();
    EXPECT_FALSE(widget->accessibleName().isEmpty()) << widget->objectName().toStdString();
  }
}

TEST_F(MainWindowTest, PicturesThatMovedAreFoundAgain) {
  QTest::mouseClick(picture_, Qt::LeftButton, {}, At(Label("pelvis")));
  window_->close();
  fs::create_directories(folder_ / "moved");
  fs::rename(folder_ / "kick.jpg", folder_ / "moved/kick.jpg");
  window_.reset();
  project_.reset();
  project_ = std::make_unique<LabelProject>(file_);
  window_ = std::make_unique<MainWindow>(project_.get(), lifter_, KeyMap());
  window_->WaitForPicture();
  EXPECT_TRUE(window_->statusBar()->currentMessage().contains("Find moved pictures"));
  window_->FindPicturesIn(QString::fromStdString((folder_ / "moved").string()));
  EXPECT_EQ(fs::weakly_canonical(window_->session().PicturePath()),
            fs::weakly_canonical(folder_ / "moved/kick.jpg"));
  EXPECT_EQ(Landmarks().size(), 1U);
}

TEST_F(MainWindowTest, ASecondWindowOnTheSameLabelsMayOnlyLook) {
  LabelProject second(file_);
  MainWindow window(&second, lifter_, KeyMap());
  window.show();
  EXPECT_TRUE(window.windowTitle().contains("read only"));
  EXPECT_FALSE(window.statusBar()->currentMessage().isEmpty());
  auto* const picture = window.findChild<PictureCanvas*>("picture");
  QTest::mouseClick(picture, Qt::LeftButton, {}, {300, 200});
  EXPECT_TRUE(window.session().labels().frames[0].people.empty());
  EXPECT_TRUE(window.close());
}

TEST_F(MainWindowTest, WhatCannotBeExportedIsSaidAndNothingEnds) {
  ClickAll();
  window_->ExportTo("/dev/null/none");
  QMessageBox* message = nullptr;
  ASSERT_TRUE(QTest::qWaitFor([&] { return message = window_->findChild<QMessageBox*>("message"); },
                              60000));
  EXPECT_FALSE(message->text().isEmpty());
  message->close();
  EXPECT_EQ(Landmarks().size(), 15U);
}

// What is shown is of the frame at hand, however the jumps and the pictures overtake each other.
TEST_F(MainWindowTest, TheNewestPictureThatIsWantedIsShown) {
  const fs::path video = folder_ / "long.mp4";
  constexpr int kFrames = 1500;
  std::vector<cv::Mat> pictures;
  for (int f = 0; f < kFrames; ++f)
    pictures.emplace_back(48, 64, CV_8UC3, cv::Scalar::all(255.0 * f / kFrames));
  testing::WriteVideo(video, pictures, 30.0);
  for (const char* left : {"long.labels.json", ".long.labels.json.journal"})
    fs::remove(folder_ / left);
  LabelProject clip(FindLabelsFile({video.string()}, "", "body15"));
  MainWindow window(&clip, lifter_, KeyMap());
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  auto* const picture = window.findChild<PictureCanvas*>("picture");
  auto* const frames = window.findChild<QSlider*>("frames");
  const auto shown_at = [&](int frame) {
    frames->setValue(frame);
    window.WaitForPicture();
    return picture->grab().toImage();
  };
  const QImage first = shown_at(0), middle = shown_at(kFrames / 2), last = shown_at(kFrames - 1);
  EXPECT_NE(first, middle);
  EXPECT_NE(middle, last);
  for (const int frame : {10, kFrames - 1, 3, kFrames - 2}) frames->setValue(frame);
  EXPECT_EQ(shown_at(kFrames / 2), middle);
  for (const int frame : {kFrames - 1, 7}) frames->setValue(frame);
  EXPECT_EQ(shown_at(0), first);
  frames->setValue(kFrames - 1);  // the window may end before it is read
}

TEST_F(MainWindowTest, AVideoIsLabelledAlongItsTimeline) {
  const fs::path file = folder_ / "clip.labels.json";
  for (const char* left : {"clip.labels.json", ".clip.labels.json.journal"})
    fs::remove(folder_ / left);
  LabelProject clip(FindLabelsFile({testing::SourcePath("samples/tags/clip.mp4").string()},
                                   file.string(), "body15"));
  MainWindow window(&clip, lifter_, KeyMap());
  window.show();
  auto* const picture = window.findChild<PictureCanvas*>("picture");
  auto* const timeline = window.findChild<QWidget*>("timeline");
  window.WaitForPicture();
  const QImage first = picture->grab().toImage();
  QTest::mouseClick(timeline, Qt::LeftButton, {}, {timeline->width() / 2, 5});
  EXPECT_EQ(window.session().frame_index(), 45U);
  window.WaitForPicture();
  EXPECT_NE(picture->grab().toImage(), first);
  const QImage before = timeline->grab().toImage();
  QTest::mouseClick(picture, Qt::LeftButton, {}, {300, 200});
  QTest::mouseClick(picture, Qt::LeftButton, {}, {340, 330});
  EXPECT_NE(timeline->grab().toImage(), before);
  window.findChild<QAction*>("next_frame")->trigger();
  window.findChild<QAction*>("copy_previous")->trigger();
  EXPECT_EQ(clip.labels().frames[46].people.at(0).landmarks.size(), 2U);
  window.findChild<QAction*>("follow_forwards")->trigger();
  window.session().WaitUntilFollowed();
  EXPECT_TRUE(clip.labels().frames[60].people.at(0).is_propagated);
  EXPECT_TRUE(clip.labels().frames[40].people.empty());
  window.findChild<QAction*>("follow_backwards")->trigger();
  window.session().WaitUntilFollowed();
  EXPECT_TRUE(clip.labels().frames[40].people.empty());  // 45 is a key picture
  window.findChild<QAction*>("follow_all")->trigger();
  window.session().WaitUntilFollowed();
  EXPECT_TRUE(clip.labels().frames[40].people.at(0).is_propagated);
  EXPECT_FALSE(clip.labels().frames[45].people.at(0).is_propagated);
}

TEST_F(MainWindowTest, ABoxIsDrawnAndSeen) {
  QTest::keyClick(window_.get(), Qt::Key_Z);
  const Eigen::Vector2d middle_px = picture_->view().ToPicture({200.0, 150.0});
  const double scale = picture_->view().scale();
  QTest::mousePress(picture_, Qt::LeftButton, {}, {150, 100});
  QTest::mouseMove(picture_, {250, 200});
  QTest::mouseRelease(picture_, Qt::LeftButton, {}, {250, 200});
  EXPECT_GT(picture_->view().scale(), 2.0 * scale);
  EXPECT_TRUE(testing::MatrixNear(
      picture_->view().ToPicture({picture_->width() / 2.0, picture_->height() / 2.0}), middle_px,
      1.0));
  EXPECT_TRUE(project_->labels().frames[0].people.empty());
}

TEST_F(MainWindowTest, MirroredItIsLabelledJustAsWell) {
  QTest::keyClick(window_.get(), Qt::Key_M, Qt::ShiftModifier);
  EXPECT_TRUE(picture_->view().is_mirrored());
  QTest::mouseClick(picture_, Qt::LeftButton, {}, At(Label("pelvis")));
  EXPECT_LT((Landmarks()[0].x_px - Label("pelvis").x_px).norm(), 1.0);
  const QImage mirrored = picture_->grab().toImage();
  QTest::keyClick(window_.get(), Qt::Key_M, Qt::ShiftModifier);
  EXPECT_NE(picture_->grab().toImage(), mirrored);
}

TEST_F(MainWindowTest, DigitsGoToTheJointOfTheNumber) {
  QTest::keyClick(picture_, Qt::Key_1);
  QTest::keyClick(picture_, Qt::Key_2);
  EXPECT_EQ(window_->session().landmark(), 11);
}

TEST_F(MainWindowTest, TheRightButtonPansWhereNoJointIs) {
  const Eigen::Vector2d before = picture_->view().offset_in_widget();
  QTest::mousePress(picture_, Qt::RightButton, {}, {300, 200});
  QTest::mouseMove(picture_, {320, 230});
  QTest::mouseRelease(picture_, Qt::RightButton, {}, {320, 230});
  EXPECT_TRUE(testing::MatrixNear(picture_->view().offset_in_widget(),
                                  before + Eigen::Vector2d(20, 30), 1e-9));
}

TEST_F(MainWindowTest, AFlippedLegIsAHintThatADoubleClickForgets) {
  ClickAll();
  window_->session().WaitUntilSolved();
  auto* const joints = window_->findChild<QListWidget*>("joints");
  auto* const hints = window_->findChild<QListWidget*>("hints");
  joints->setCurrentRow(*FindLayout("body15")->Find("right_knee"));
  window_->findChild<QAction*>("flip_limb")->trigger();
  window_->session().WaitUntilSolved();
  window_->Refresh();
  ASSERT_GT(hints->count(), 0);
  EXPECT_FALSE(project_->labels().frames[0].people[0].hints.empty());
  while (hints->count() > 0) {
    const QPoint at = hints->visualItemRect(hints->item(0)).center();
    QTest::mouseClick(hints->viewport(), Qt::LeftButton, {}, at);
    QTest::mouseDClick(hints->viewport(), Qt::LeftButton, {}, at);
  }
  EXPECT_TRUE(project_->labels().frames[0].people[0].hints.empty());
}

TEST_F(MainWindowTest, ThePoseTurnsByTheMouse) {
  ClickAll();
  window_->session().WaitUntilSolved();
  auto* const pose = window_->findChild<PoseCanvas*>("pose");
  const double yaw_rad = pose->orbit().yaw_rad;
  QTest::mousePress(pose, Qt::LeftButton, {}, {50, 50});
  QTest::mouseMove(pose, {90, 50});
  QTest::mouseRelease(pose, Qt::LeftButton, {}, {90, 50});
  EXPECT_NE(pose->orbit().yaw_rad, yaw_rad);
  EXPECT_FALSE(pose->grab().toImage().isNull());
}

}  // namespace
}  // namespace poselift
