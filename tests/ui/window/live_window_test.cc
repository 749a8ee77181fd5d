// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The window over a camera, on the sample clip of a person in tags played as if it were one, and
// on a made-up camera. Checked: what is shown, what freezing and recording leave, and that errors
// of a camera are told and it can be tried again.
#include "ui/window/live_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <QAction>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <cerrno>
#include <chrono>
#include <thread>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "src/capture/fourcc.h"
#include "src/io/bvh.h"
#include "src/io/image.h"
#include "src/io/labels.h"
#include "src/io/poses_json.h"
#include "src/io/video.h"
#include "tests/support/fake_camera.h"
#include "tests/support/support.h"
#include "ui/live/live_inputs.h"
#include "ui/window/camera_dialog.h"
#include "ui/window/live_canvas.h"
#include "ui/window/live_pose.h"
#include "ui/window/main_window.h"
#include "ui/window/welcome.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::FakeBuffer;
using ::testing::HasSubstr;
using testing::ScratchDir;
using testing::SourcePath;
using State = LiveStatus::State;

constexpr int kPatience_ms = 120000;  // for the slowest of machines

class LiveWindowTest : public ::testing::Test {
 protected:
  LiveWindowTest() {
    sample_.view.input = SourcePath("samples/tags/clip.mp4");
    sample_.view.camera = SourcePath("samples/tags/camera.yaml");
    sample_.tags = SourcePath("samples/tags/tags.toml");
    device_.formats = {{kFourccYuyv, "yuyv", {{{64, 48}, {30.0}}}}};
    device_.frame = [](int) { return FakeBuffer{testing::AsYuyv(testing::GreyRamp({64, 48}))}; };
    watched_.view.input = device_.path;
    watched_.view.device.size = "64x48";
  }

  void Open(std::function<LiveParts()> open) {
    window_ = std::make_unique<LiveWindow>(
        std::move(open), LiveWindow::Options{"clip", ScratchDir() / "live"}, lifter_, KeyMap());
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  }
  void OpenSample() {
    Open([this] { return OpenLive(sample_, lifter_); });
  }
  // Whoever wears the tags stands still before a camera, as long as it takes.
  void OpenWearer() {
    const std::string jpeg =
        testing::AsJpeg(VideoFile(SourcePath("samples/tags/clip.mp4")).Next()->bgr);
    device_.formats = {{kFourccMjpg, "mjpg", {{{1280, 720}, {30.0}}}}};
    device_.frame = [jpeg](int) {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      return FakeBuffer{jpeg};
    };
    sample_.view.input = device_.path;
    Open([this] { return OpenLive(sample_, lifter_, &device_); });
  }
  void OpenDevice() {
    Open([this] { return OpenLive(watched_, lifter_, &device_); });
  }
  bool Wait(const std::function<bool()>& is_there) {
    return QTest::qWaitFor(is_there, kPatience_ms);
  }
  bool WaitForEnd() {
    return Wait([this] { return window_->status().state == State::kEnded; });
  }
  bool WaitForPose() {
    return Wait([this] { return Find<LivePoseCanvas>("live_pose")->has_pose(); });
  }
  template <typename T>
  T* Find(const char* name) const {
    return window_->findChild<T*>(name);
  }
  std::string Problem() const {
    auto* const problem = Find<QLabel>("problem");
    return problem->isVisible() ? problem->text().toStdString() : "";
  }

  Dictionary dictionary_ = ReadDictionary(DefaultDictionaryPath());
  PhotoLifter lifter_{dictionary_};
  LiveInputs sample_, watched_;
  testing::FakeCamera device_;
  std::unique_ptr<LiveWindow> window_;
};

TEST_F(LiveWindowTest, ShowsTagsAndPoseAndAFrozenFrameIsLabelledFromThem) {
  OpenSample();
  ASSERT_TRUE(WaitForPose()) << Problem();
  EXPECT_GE(Find<LiveCanvas>("live_picture")->view().tags.size(), 3U);
  EXPECT_THAT(Find<QLabel>("live_line")->text().toStdString(), HasSubstr(" tags"));
  QTest::keyClick(window_.get(), Qt::Key_F);
  ASSERT_NE(window_->labels(), nullptr) << Problem();
  LabelSession& labels = window_->labels()->session();
  EXPECT_TRUE(window_->labels()->isVisible());
  ASSERT_EQ(labels.Frame().people.size(), 1U);
  EXPECT_GE(labels.Frame().people[0].landmarks.size(), 10U);
  labels.WaitUntilSolved();
  window_->labels()->Refresh();
  ASSERT_NE(labels.pose(), nullptr);
  EXPECT_LT(labels.pose()->reprojection_rms_px, 25.0);
  const fs::path folder = ScratchDir() / "live";
  EXPECT_EQ(ReadImage(folder / "still-0001.png").size(), cv::Size(1280, 720));

  QTest::keyClick(window_.get(), Qt::Key_F);
  EXPECT_EQ(labels.frame_index(), 1U);
  EXPECT_EQ(labels.labels().frames.size(), 2U);
  window_->labels()->close();
  EXPECT_EQ(ReadLabels(folder / "labels.json").frames.size(), 2U);
}

TEST_F(LiveWindowTest, RecordsAndStops) {
  OpenWearer();
  ASSERT_TRUE(WaitForPose()) << Problem();
  QTest::keyClick(window_.get(), Qt::Key_R);
  EXPECT_EQ(Find<QAction>("record")->text(), "Stop recording");
  ASSERT_TRUE(Wait([this] { return window_->status().num_recorded >= 3; })) << Problem();
  const fs::path dir = window_->status().recording;
  EXPECT_EQ(dir, ScratchDir() / "live" / "recording-0001");
  QTest::keyClick(window_.get(), Qt::Key_R);
  ASSERT_TRUE(Wait([this] { return window_->status().recording.empty(); }));
  EXPECT_EQ(Find<QAction>("record")->text(), "Record");
  const auto num_frames = static_cast<size_t>(window_->status().num_recorded);
  EXPECT_EQ(ReadPosesJson(dir / "poses.json").frames.size(), num_frames);
  EXPECT_GE(ReadBvh(dir / "poses.bvh").frames.size(), 1U);
  EXPECT_THAT(Find<QLabel>("live_folder")->text().toStdString(), HasSubstr("recording-0001"));
  EXPECT_EQ(Problem(), "");
}

TEST_F(LiveWindowTest, ABusyCameraIsToldAndTriedAgain) {
  device_.errors[VIDIOC_STREAMON] = EBUSY;
  OpenDevice();
  ASSERT_TRUE(WaitForEnd());
  EXPECT_THAT(Problem(), HasSubstr("used by another program"));
  EXPECT_TRUE(window_->isVisible());
  EXPECT_FALSE(Find<QAction>("freeze")->isEnabled());
  device_.errors.clear();
  device_.Allow(2);
  QTest::keyClick(window_.get(), Qt::Key_A);
  ASSERT_TRUE(Wait([this] { return Find<LiveCanvas>("live_picture")->view().number > 0; }));
  EXPECT_EQ(Problem(), "");
  EXPECT_FALSE(Find<QAction>("watch_again")->isEnabled());
}

TEST_F(LiveWindowTest, UnpluggedWhileItRecordsLeavesAVideoAndTheLastPicture) {
  device_.num_frames = 4;
  device_.unplugged_at_end = true;
  device_.Allow(0);
  OpenDevice();
  QTest::keyClick(window_.get(), Qt::Key_R);  // before the first picture
  device_.Allow(1);
  ASSERT_TRUE(Wait([this] { return window_->status().num_recorded == 1; })) << Problem();
  device_.Allow(4);
  ASSERT_TRUE(WaitForEnd());
  EXPECT_THAT(Problem(), HasSubstr("unplugged"));
  EXPECT_TRUE(VideoFile(ScratchDir() / "live" / "recording-0001" / "video.mkv").Next());
  EXPECT_FALSE(Find<QAction>("record")->isEnabled());
  // What was seen last can be kept still; nothing is known of a pose.
  QTest::keyClick(window_.get(), Qt::Key_F);
  ASSERT_NE(window_->labels(), nullptr);
  EXPECT_TRUE(window_->labels()->session().Frame().people.empty());
}

TEST_F(LiveWindowTest, WhatCannotBeWrittenIsTold) {
  device_.Allow(1);
  OpenDevice();
  window_->SetFolder(testing::WriteScratch("file", ""));
  ASSERT_TRUE(Wait([this] { return window_->status().num_pictures == 1; }));
  QTest::keyClick(window_.get(), Qt::Key_F);
  EXPECT_THAT(Problem(), HasSubstr("No still: "));
  EXPECT_EQ(window_->labels(), nullptr);
  QTest::keyClick(window_.get(), Qt::Key_R);
  device_.Allow(2);
  ASSERT_TRUE(Wait([this] { return !window_->status().recording_message.empty(); }));
  EXPECT_THAT(Problem(), HasSubstr("Not recorded: "));
  EXPECT_EQ(window_->status().state, State::kRunning);
}

TEST_F(LiveWindowTest, ClosingItEndsTheCameraAndLeavesTheLabels) {
  device_.Allow(1);
  OpenDevice();
  ASSERT_TRUE(Wait([this] { return window_->status().num_pictures == 1; }));
  QTest::keyClick(window_.get(), Qt::Key_F);
  window_->close();
  EXPECT_EQ(device_.num_open(), 0);
  EXPECT_TRUE(window_->labels()->isVisible());
}

TEST_F(LiveWindowTest, TheWheelZoomsAtTheCursorTheMousePansAndTwiceIsTheWholePicture) {
  device_.Allow(1);
  OpenDevice();
  auto* const canvas = Find<LiveCanvas>("live_picture");
  ASSERT_TRUE(Wait([&] { return canvas->view().number > 0; }));
  canvas->grab();
  const double whole = canvas->transform().scale();
  const Eigen::Vector2d before_px = canvas->transform().ToPicture({100.0, 80.0});
  const QPoint cursor(100, 80);
  QWheelEvent wheel(cursor, canvas->mapToGlobal(cursor), {}, {0, 480}, Qt::NoButton, {},
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(canvas, &wheel);
  EXPECT_NEAR(canvas->transform().scale(), 2.0 * whole, 1e-9);
  EXPECT_TRUE(testing::MatrixNear(canvas->transform().ToPicture({100.0, 80.0}), before_px, 1e-9));
  QTest::mousePress(canvas, Qt::LeftButton, {}, cursor);
  QTest::mouseMove(canvas, cursor + QPoint(30, -10));
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, cursor + QPoint(30, -10));
  EXPECT_TRUE(testing::MatrixNear(canvas->transform().ToPicture({130.0, 70.0}), before_px, 1e-9));
  QTest::mouseDClick(canvas, Qt::LeftButton);
  canvas->grab();
  EXPECT_EQ(canvas->transform().scale(), whole);
}

TEST_F(LiveWindowTest, KeysAreThoseOfTheFileAndToldByF1) {
  device_.Allow(1);
  const KeyMap keys = KeyMap::Read(testing::WriteScratch("keys.toml", "freeze = 'S'\n"));
  window_ = std::make_unique<LiveWindow>([this] { return OpenLive(watched_, lifter_, &device_); },
                                         LiveWindow::Options{"clip", ScratchDir() / "live"},
                                         lifter_, keys);
  EXPECT_THAT(Find<QAction>("freeze")->toolTip().toStdString(), HasSubstr("(S)"));
  window_->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  QTest::keyClick(window_.get(), Qt::Key_F1);
  auto* const box = Find<QMessageBox>("keys");
  ASSERT_NE(box, nullptr);
  EXPECT_THAT(box->text().toStdString(), HasSubstr("<b>S</b>&nbsp;&nbsp;</td><td>Keep this"));
  EXPECT_EQ(box->text().toStdString().find("Next picture"), std::string::npos);
  box->close();
}

TEST(CameraDialog, ListsCamerasByNameWithFiles) {
  CameraInfo webcam{.path = "/dev/video0", .name = "Webcam C270"};
  CameraInfo busy{.path = "/dev/video2", .problem = "/dev/video2: may not be opened"};
  CameraDialog dialog({webcam, busy});
  auto* const list = dialog.findChild<QListWidget*>("cameras");
  ASSERT_EQ(list->count(), 2);
  EXPECT_THAT(list->item(0)->text().toStdString(), HasSubstr("Webcam C270"));
  EXPECT_THAT(list->item(1)->text().toStdString(), HasSubstr("may not be opened"));
  EXPECT_EQ(dialog.device(), "/dev/video0");
  list->setCurrentRow(1);
  dialog.findChild<QLineEdit*>("tags_file")->setText("tags.toml");
  EXPECT_EQ(dialog.device(), "/dev/video2");
  EXPECT_EQ(dialog.tags_file(), "tags.toml");
  EXPECT_EQ(dialog.camera_file(), "");
}

TEST(CameraDialog, SaysWhatToDoWithoutACamera) {
  CameraDialog dialog({});
  ASSERT_NE(dialog.findChild<QLabel*>("no_camera"), nullptr);
  EXPECT_EQ(dialog.findChild<QPushButton*>("watch"), nullptr);
  EXPECT_EQ(dialog.device(), "");
}

TEST(Welcome, ACameraThatIsChosenIsWhatOneStartsWith) {
  Welcome welcome({}, nullptr, [] {
    return std::vector<CameraInfo>{{.path = "/dev/video7", .name = "Webcam"}};
  });
  QTimer::singleShot(0, &welcome, [&] {
    auto* const dialog = welcome.findChild<CameraDialog*>("camera_dialog");
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QLineEdit*>("camera_file")->setText("cam.yaml");
    QTest::mouseClick(dialog->findChild<QPushButton*>("watch"), Qt::LeftButton);
  });
  QTest::mouseClick(welcome.findChild<QPushButton*>("camera"), Qt::LeftButton);
  EXPECT_EQ(welcome.inputs(), std::vector<std::string>{"/dev/video7"});
  EXPECT_EQ(welcome.camera_file(), "cam.yaml");
  EXPECT_EQ(welcome.result(), QDialog::Accepted);
}

}  // namespace
}  // namespace poselift
