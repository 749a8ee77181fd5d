// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: mouse and keys on the window of a pose without a picture, the dictionary that ships, the
// files that are exported. Checked: key frames are made, dragged in time, looked at between, played
// and exported at their rate.
#include <gtest/gtest.h>

#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

#include "src/io/motion_file.h"
#include "tests/ui/window/sample_window.h"
#include "ui/label/new_pose.h"
#include "ui/window/angle_plot_widget.h"
#include "ui/window/key_timeline.h"
#include "ui/window/motion_dock.h"
#include "ui/window/player.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

class KeyFramesTest : public ::testing::Test {
 protected:
  // Three key frames: standing, a hand up, a foot up besides.
  void SetUp() override {
    folder_ = testing::ScratchDir();
    file_ = folder_ / "hero.labels.json";
    for (const char* left : {"hero.labels.json", ".hero.labels.json.journal"})
      fs::remove(folder_ / left);
    CreatePoseFile(file_, "body15", dictionary_.skeleton);
    Open();
    QTest::keyClick(window_.get(), Qt::Key_Insert, Qt::ShiftModifier);
    Drag("left_wrist", {30, -90});
    QTest::keyClick(window_.get(), Qt::Key_Insert, Qt::ShiftModifier);
    Drag("right_knee", {-20, -30});
  }
  void Open() {
    window_.reset();
    project_.reset();
    project_ = std::make_unique<LabelProject>(file_);
    window_ = std::make_unique<MainWindow>(project_.get(), lifter_, KeyMap());
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    timeline_ = window_->findChild<KeyTimeline*>();
    ASSERT_NE(timeline_, nullptr);
    Wait();
  }
  LabelSession& session() const { return window_->session(); }
  void Wait() const {
    session().WaitUntilSolved();
    session().WaitUntilSmoothed();
    window_->Refresh();
  }
  void Drag(std::string_view name, QPoint by) const {
    Wait();
    auto* const canvas = window_->findChild<PoseCanvas*>("pose");
    const auto handle = std::ranges::find(session().handles(), name, &PoseHandle::name);
    const auto index = static_cast<size_t>(handle - session().handles().begin());
    const QPoint from = canvas->HandleAt(index)->toPoint();
    QTest::mousePress(canvas, Qt::LeftButton, {}, from);
    QTest::mouseMove(canvas, from + by);
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, from + by);
    Wait();
  }
  QPoint At(int number) const {
    return QPointF(timeline_->X(number), timeline_->height() - 15.0).toPoint();
  }
  void DragKey(int from, int to, Qt::KeyboardModifiers keys = {}) const {
    const QPoint at = At(from), end = At(to);
    QTest::mousePress(timeline_, Qt::LeftButton, keys, at);
    for (const QPoint& on_the_way : {(at + end) / 2, end}) {
      QMouseEvent move(QEvent::MouseMove, on_the_way, timeline_->mapToGlobal(on_the_way),
                       Qt::NoButton, Qt::LeftButton, keys);
      QCoreApplication::sendEvent(timeline_, &move);
    }
    QTest::mouseRelease(timeline_, Qt::LeftButton, keys, end);
    Wait();
  }
  std::vector<int> Numbers() const { return session().Keys().numbers; }
  template <class Widget>
  Widget* Find(const char* name) const {
    return window_->findChild<Widget*>(name);
  }

  Dictionary dictionary_ = ReadDictionary(DefaultDictionaryPath());
  PhotoLifter lifter_{dictionary_};
  fs::path folder_, file_;
  std::unique_ptr<LabelProject> project_;
  std::unique_ptr<MainWindow> window_;
  KeyTimeline* timeline_ = nullptr;
};

TEST_F(KeyFramesTest, TheDockIsOfKeyFrames) {
  EXPECT_EQ(Find<QDockWidget>("frames_dock")->windowTitle(), "Key frames");
  EXPECT_FALSE(Find<QSlider>("frames")->isVisible());
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 30}));
  EXPECT_EQ(Find<QLabel>("key_text")->text(), "Key frame 3 of 3:");
  EXPECT_EQ(Find<QSpinBox>("key_number")->value(), 30);
}

TEST_F(KeyFramesTest, TheMouseMovesThemInTimeAndShiftAllBehind) {
  DragKey(15, 10);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 10, 30}));
  EXPECT_EQ(session().frame_index(), 1U);
  DragKey(10, 20, Qt::ShiftModifier);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 20, 40}));
  DragKey(20, 55);  // not beyond the next
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 39, 40}));
  for (int i = 0; i < 3; ++i) QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 30}));
  QTest::mouseClick(timeline_, Qt::LeftButton, {}, At(15));  // a click goes there and no more
  EXPECT_EQ(session().frame_index(), 1U);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 30}));
}

TEST_F(KeyFramesTest, KeysAndNumbersMoveThemToo) {
  QTest::keyClick(window_.get(), Qt::Key_Left, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 29}));
  auto* const number = Find<QSpinBox>("key_number");
  number->setFocus();
  number->selectAll();
  QTest::keyClicks(number, "45");
  QTest::keyClick(number, Qt::Key_Return);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 45}));
  EXPECT_FALSE(number->hasFocus());
  auto* const rate = Find<QDoubleSpinBox>("key_rate");
  rate->setFocus();
  rate->selectAll();
  QTest::keyClicks(rate, rate->locale().toString(24));
  QTest::keyClick(rate, Qt::Key_Return);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 12, 36}));
  EXPECT_EQ(session().Keys().fps, 24.0);
  QTest::keyClick(window_.get(), Qt::Key_S, Qt::ControlModifier);
  Open();
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 12, 36}));
  EXPECT_EQ(Find<QDoubleSpinBox>("key_rate")->value(), 24.0);
}

TEST_F(KeyFramesTest, TheMouseBesideShowsTheMotionAndAButtonKeysIt) {
  auto* const canvas = window_->findChild<PoseCanvas*>("pose");
  const QImage key = canvas->grab().toImage();
  QTest::mouseClick(timeline_, Qt::LeftButton, {}, At(22));
  EXPECT_TRUE(session().IsBetween());
  EXPECT_EQ(session().Number(), 22);
  EXPECT_NE(canvas->grab().toImage(), key);
  EXPECT_FALSE(canvas->HandleAt(3));
  EXPECT_FALSE(Find<QSpinBox>("key_number")->isEnabled());
  QTest::mouseClick(Find<QPushButton>("button_add_key_frame"), Qt::LeftButton);
  Wait();
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 22, 30}));
  EXPECT_TRUE(canvas->HandleAt(3));
  QTest::mouseClick(Find<QPushButton>("button_remove_frame"), Qt::LeftButton);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 30}));
}

TEST_F(KeyFramesTest, ArePlayedThroughAllFramesBetween) {
  session().GoToFrame(0);
  Wait();
  auto* const player = window_->findChild<Player*>();
  std::vector<int> due;
  QObject::connect(player, &Player::FrameDue, [&](int frame) {
    due.push_back(frame);
    EXPECT_TRUE(session().ShowsMotion()) << frame;
  });
  QTest::keyClick(window_.get(), Qt::Key_K);
  EXPECT_TRUE(player->is_playing());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !player->is_playing(); }, 60000));
  ASSERT_FALSE(due.empty());
  EXPECT_TRUE(std::ranges::is_sorted(due));
  EXPECT_EQ(due.back(), 30);
  EXPECT_EQ(session().frame_index(), 2U);  // the last key frame, to be posed
  EXPECT_FALSE(session().IsBetween());
}

TEST_F(KeyFramesTest, TheirAnglesArePlottedAndAClickInThePlotGoesThere) {
  window_->findChild<MotionDock*>()->show();
  QCoreApplication::processEvents();
  auto* const plot = window_->findChild<AnglePlotWidget*>();
  EXPECT_EQ(Find<QLabel>("motion_text")->text(), "Person 0: 31 frames from 3 key frames");
  const QImage before = plot->grab().toImage();
  QTest::mouseClick(plot, Qt::LeftButton, {}, {plot->width() / 3, plot->height() / 2});
  EXPECT_TRUE(session().IsBetween());
  EXPECT_NE(plot->grab().toImage(), before);
}

TEST_F(KeyFramesTest, AreExportedAsAMotionAtTheirRate) {
  DragKey(15, 9);
  window_->ExportMotionTo(QString::fromStdString((folder_ / "hero.bvh").string()));
  window_->session().WaitUntilExported();
  const Motion motion = ReadMotion(folder_ / "hero.bvh");
  EXPECT_EQ(motion.frames.size(), 31U);
  EXPECT_NEAR(motion.frame_time_s, 1.0 / 30.0, 1e-7);
}

}  // namespace
}  // namespace poselift
