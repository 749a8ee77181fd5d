// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: a camera of the kernel's that shows a person in tags (tests/v4l2_vm/make_clip.cc), named by
// POSELIFT_CAMERA, its clip's folder by POSELIFT_CAMERA_CLIP; guest.sh has one. Checked: the window
// finds it, tracks the person, records what the camera sent and keeps a frame to be labelled.
#include <gtest/gtest.h>

#include <QListWidget>
#include <QTest>
#include <cstdlib>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "src/capture/camera_list.h"
#include "src/io/image.h"
#include "src/io/poses_json.h"
#include "src/io/video.h"
#include "tests/support/support.h"
#include "ui/live/live_inputs.h"
#include "ui/window/camera_dialog.h"
#include "ui/window/live_pose.h"
#include "ui/window/live_window.h"
#include "ui/window/main_window.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

bool Wait(const std::function<bool()>& is_there) {
  constexpr int kPatience_ms = 60000;  // of an emulated machine
  return QTest::qWaitFor(is_there, kPatience_ms);
}

TEST(LiveCamera, IsFoundTrackedRecordedAndKeptStill) {
  const char* const device = std::getenv("POSELIFT_CAMERA");
  const char* const clip = std::getenv("POSELIFT_CAMERA_CLIP");
  if (!device || !clip) GTEST_SKIP() << "skipped: POSELIFT_CAMERA names no camera";
  CameraDialog dialog(ListCameras());
  auto* const list = dialog.findChild<QListWidget*>("cameras");
  for (int row = 0; row < list->count() && dialog.device() != device; ++row)
    list->setCurrentRow(row);
  ASSERT_EQ(dialog.device(), device);

  LiveInputs inputs;
  inputs.view.input = dialog.device();
  inputs.view.camera = fs::path(clip) / "camera.yaml";
  inputs.view.device.size = "640x480";
  inputs.tags = fs::path(clip) / "tags.toml";
  const Dictionary dictionary = ReadDictionary(DefaultDictionaryPath());
  const PhotoLifter lifter(dictionary);
  const fs::path folder = testing::ScratchDir() / "live";
  LiveWindow window([&] { return OpenLive(inputs, lifter); }, {"loop", folder}, lifter, KeyMap());
  window.show();
  ASSERT_TRUE(Wait([&] { return window.findChild<LivePoseCanvas*>("live_pose")->has_pose(); }))
      << window.status().message;

  QTest::keyClick(&window, Qt::Key_R);
  ASSERT_TRUE(Wait([&] { return window.status().num_recorded >= 3; }));
  QTest::keyClick(&window, Qt::Key_R);
  ASSERT_TRUE(Wait([&] { return window.status().recording.empty(); }));
  const fs::path recording = folder / "recording-0001";
  EXPECT_EQ(std::ssize(ReadPosesJson(recording / "poses.json").frames),
            window.status().num_recorded);
  EXPECT_EQ(VideoFile(recording / "video.mkv").Next()->bgr.size(), cv::Size(640, 480));

  QTest::keyClick(&window, Qt::Key_F);
  ASSERT_NE(window.labels(), nullptr);
  ASSERT_EQ(window.labels()->session().Frame().people.size(), 1U);
  EXPECT_GE(window.labels()->session().Frame().people[0].landmarks.size(), 10U);
  EXPECT_EQ(ReadImage(folder / "still-0001.png").size(), cv::Size(640, 480));
}

}  // namespace
}  // namespace poselift
