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
#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <mutex>

#include "src/io/video.h"
#include "tests/support/walk_labels.h"
#include "tests/ui/window/sample_window.h"
#include "ui/label/new_pose.h"
#include "ui/live/live_inputs.h"
#include "ui/window/live_window.h"
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

// The first frames of the clip of a person in tags, each and every one whatever the machine does;
// then it waits, as a camera does.
class HeldClip : public FrameSource {
 public:
  cv::Size size_px() const override { return clip_.size_px(); }
  std::optional<VideoFrame> Next() override {
    if (num_given_ < kFrames) {
      ++num_given_;
      return clip_.Next();
    }
    std::unique_lock lock(mutex_);
    stopped_.wait(lock, [this] { return stop_; });
    return std::nullopt;
  }
  std::optional<double> Skip_s() override { return clip_.Skip_s(); }
  void Stop() override {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
    stopped_.notify_all();
  }

  static constexpr int kFrames = 20;

 private:
  VideoFile clip_{testing::SourcePath("samples/tags/clip.mp4"), Pictures::kBoth};
  int num_given_ = 0;
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;
};

TEST_F(Screenshots, OfACameraIsTaken) {
  LiveInputs inputs;
  inputs.view.input = testing::SourcePath("samples/tags/clip.mp4");
  inputs.view.camera = testing::SourcePath("samples/tags/camera.yaml");
  inputs.tags = testing::SourcePath("samples/tags/tags.true.toml");
  const auto open = [&] {
    LiveParts parts = OpenLive(inputs, lifter_);
    parts.source = std::make_unique<HeldClip>();
    return parts;
  };
  LiveWindow live(open, {"clip.mp4", "live"}, lifter_, KeyMap());
  live.show();
  constexpr int kPatience_ms = 120000;
  ASSERT_TRUE(QTest::qWaitFor([&] { return live.status().num_pictures == HeldClip::kFrames; },
                              kPatience_ms));
  Take("label-live", &live);
}

TEST_F(Screenshots, OfAPoseFromNothing) {
  window_->close();  // the mouse would find it
  const auto file = folder_ / "hero.labels.json";
  for (const char* left : {"hero.labels.json", ".hero.labels.json.journal"})
    testing::fs::remove(folder_ / left);
  CreatePoseFile(file, "body15", dictionary_.skeleton);
  LabelProject project(file);
  MainWindow window(&project, lifter_, KeyMap());
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  LabelSession& session = window.session();
  const auto solve = [&] {
    session.WaitUntilSolved();
    window.Refresh();
  };
  solve();
  Take("label-new-pose", &window);
  auto* const pose = window.findChild<PoseCanvas*>("pose");
  const auto at = [&](std::string_view name) {
    const auto handle = std::ranges::find(session.handles(), name, &PoseHandle::name);
    return pose->HandleAt(static_cast<size_t>(handle - session.handles().begin()))->toPoint();
  };
  QTest::keyClick(&window, Qt::Key_Insert, Qt::ShiftModifier);
  solve();
  QTest::mouseClick(pose, Qt::RightButton, {}, at("right_ankle"));
  solve();
  for (const auto& [name, by] : {std::pair{"left_wrist", QPoint(40, -110)},
                                 {"right_wrist", QPoint(-30, -60)},
                                 {"left_knee", QPoint(-35, -20)}}) {
    const QPoint from = at(name);
    QTest::mousePress(pose, Qt::LeftButton, {}, from);
    QTest::mouseMove(pose, from + by);
    solve();
    QTest::mouseRelease(pose, Qt::LeftButton, {}, from + by);
    solve();
  }
  session.MoveKey(1, 20, Along::kAlone);
  session.Do(Action::kAddKeyFrame);
  session.GoToFrame(1);
  solve();
  session.WaitUntilSmoothed();
  window.Refresh();
  QTest::mouseMove(pose, at("right_elbow"));
  Take("label-posing", &window);
  session.GoToNumber(12);
  window.findChild<QWidget*>("motion_dock")->show();
  window.Refresh();
  Take("label-between-keys", &window);
}

// With its video where the real data is.
TEST_F(Screenshots, OfAMotion) {
  Labels labels = testing::ShortWalk(80, 30);
  const auto data = testing::DataDir();
  if (!data)
    for (FrameLabels& frame : labels.frames) frame.image.clear();
  LabelProject walk(testing::FreshLabelsFile(folder_, labels));
  if (data) walk.Relink(*data / "photos");
  MainWindow window(&walk, lifter_, KeyMap());
  window.resize(1400, 900);
  window.show();
  window.findChild<QAction*>("smooth_motion")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.session().motion() != nullptr; }, 180000));
  auto* const angles = window.findChild<QListWidget*>("angles");
  for (const QString name : {"left_hip.flexion", "left_elbow.flexion"})
    angles->findItems(name, Qt::MatchExactly).front()->setCheckState(Qt::Checked);
  window.session().GoToFrame(52);
  window.session().GoToLandmark(window.session().layout().Find("right_wrist").value());
  window.session().WaitUntilSolved();
  window.Refresh();
  window.WaitForPicture();
  Take("label-motion", &window);
}

}  // namespace
}  // namespace poselift
