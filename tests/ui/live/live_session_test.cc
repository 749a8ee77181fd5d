// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A session on the sample clip of a person in tags, by the models that ship, and on a made-up
// camera. Real: the thread, tracking, the files of a recording. Checked: poses come, what is frozen
// and recorded is whole, what ends a session is said, and nothing waits for who shows it.
#include "ui/live/live_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <condition_variable>
#include <future>
#include <opencv2/core.hpp>

#include "lift/dictionary_file.h"
#include "src/capture/fourcc.h"
#include "src/capture/open_frame_source.h"
#include "src/io/bvh.h"
#include "src/io/image.h"
#include "src/io/poses_json.h"
#include "src/io/video.h"
#include "tests/support/fake_camera.h"
#include "tests/support/mutation.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"
#include "ui/live/live_inputs.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::FakeBuffer;
using testing::FakeCamera;
using ::testing::HasSubstr;
using testing::ScratchDir;
using testing::SourcePath;
using State = LiveStatus::State;

// Of the first frames of a source.
class FirstFrames : public FrameSource {
 public:
  FirstFrames(std::unique_ptr<FrameSource> source, int count)
      : source_(std::move(source)), left_(count) {}
  cv::Size size_px() const override { return source_->size_px(); }
  std::optional<VideoFrame> Next() override { return left_-- > 0 ? source_->Next() : std::nullopt; }
  std::optional<double> Skip_s() override { return source_->Skip_s(); }

 private:
  std::unique_ptr<FrameSource> source_;
  int left_;
};

class LiveSessionTest : public ::testing::Test {
 protected:
  LiveSessionTest() {
    sample_.view.input = SourcePath("samples/tags/clip.mp4");
    sample_.view.camera = SourcePath("samples/tags/camera.yaml");
    sample_.view.dictionary = SourcePath("data/default.pldict");
    sample_.view.motion_model = SourcePath("data/default.plmotion");
    sample_.tags = SourcePath("samples/tags/tags.toml");
    device_.formats = {{kFourccYuyv, "yuyv", {{{64, 48}, {30.0}}}}};
    device_.frame = [](int) { return FakeBuffer{testing::AsYuyv(testing::GreyRamp({64, 48}))}; };
    watched_.view.input = device_.path;
    watched_.view.device.size = "64x48";
  }

  // Opens when Go is called: what a test does first is in force from the first picture on.
  void Start(std::function<LiveParts()> open) {
    session_ = std::make_unique<LiveSession>(
        [this, open = std::move(open)] {
          go_.get_future().wait();
          return open();
        },
        [this] {
          const std::scoped_lock lock(mutex_);
          ++num_told_;
          changed_.notify_all();
        });
  }
  void Go() { go_.set_value(); }

  // The frames of the clip, each and every one; as fast as they can be looked at.
  LiveParts OpenClip(int num_frames) {
    LiveParts parts = OpenLive(sample_, lifter_);
    FrameSourceOptions options{.pictures = Pictures::kBoth};
    parts.source =
        std::make_unique<FirstFrames>(OpenFrameSource(sample_.view.input, options), num_frames);
    return parts;
  }

  LiveSession::Latest WaitFor(const std::function<bool(const LiveSession::Latest&)>& is_there) {
    for (;;) {
      const int num_known = NumTold();
      LiveSession::Latest latest = session_->Take();
      if (is_there(latest) || latest.status.state == State::kEnded) return latest;
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return num_told_ > num_known; });
    }
  }
  int NumTold() {
    const std::scoped_lock lock(mutex_);
    return num_told_;
  }
  LiveSession::Latest WaitForEnd() {
    return WaitFor([](const LiveSession::Latest&) { return false; });
  }

  Dictionary dictionary_ = ReadDictionary(SourcePath("data/default.pldict"));
  PhotoLifter lifter_{dictionary_};
  LiveInputs sample_, watched_;
  FakeCamera device_;
  std::promise<void> go_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int num_told_ = 0;
  std::unique_ptr<LiveSession> session_;  // the last, for its thread uses the others
};

TEST_F(LiveSessionTest, TracksTheSampleClipAtItsSpeed) {
  Start([this] { return OpenLive(sample_, lifter_); });
  EXPECT_EQ(session_->Take().status.state, State::kOpening);
  EXPECT_FALSE(session_->Freeze());
  Go();
  const auto first = WaitFor([](const auto& latest) { return latest.view.pose.has_value(); });
  ASSERT_TRUE(first.view.pose) << first.status.message;
  EXPECT_GE(first.view.tags.size(), 3U);
  EXPECT_EQ(first.view.bgr.size(), cv::Size(1280, 720));
  EXPECT_TRUE(first.status.has_tags);
  const auto end = WaitForEnd();
  EXPECT_EQ(end.status.message, "there are no more pictures");
  EXPECT_EQ(end.status.num_pictures + end.status.num_lost, 90);
  EXPECT_TRUE(std::isfinite(end.status.latency_s));
  EXPECT_THAT(StatusLine(end.status, end.view), HasSubstr("tags"));
}

TEST_F(LiveSessionTest, RecordsWhatTrackDoes) {
  Start([this] { return OpenClip(12); });
  const fs::path dir = ScratchDir() / "new" / "recording";
  session_->Record(dir);
  Go();
  const auto end = WaitForEnd();
  EXPECT_EQ(end.status.recording_message, "");
  EXPECT_EQ(end.status.num_recorded, 12);
  EXPECT_TRUE(end.status.recording.empty());
  const Poses poses = ReadPosesJson(dir / "poses.json");
  EXPECT_EQ(poses.frames.size(), 12U);
  EXPECT_GT(ReadBvh(dir / "poses.bvh").frames.size(), 5U);
  for (const char* name : {"angles.csv", "angles_sigma.csv"}) EXPECT_TRUE(fs::exists(dir / name));
  EXPECT_FALSE(fs::exists(dir / "video.mkv"));  // it is recorded already
  EXPECT_EQ(testing::RunProgram("info " + (dir / "poses.json").string()).code, 0);
  EXPECT_EQ(testing::RunProgram("info " + (dir / "poses.bvh").string()).code, 0);
}

TEST_F(LiveSessionTest, CountsWhatNobodyTook) {
  Start([this] { return OpenClip(5); });
  std::unique_lock lock(mutex_);
  Go();
  changed_.wait(
      lock, [this] { return num_told_ == 2; });  // of the first, which nobody takes, and the end
  lock.unlock();
  const auto latest = session_->Take();
  EXPECT_EQ(latest.status.state, State::kEnded);
  EXPECT_EQ(latest.view.number, 5);
  EXPECT_EQ(latest.status.num_not_shown, 4);
}

TEST_F(LiveSessionTest, FreezesAPictureOfACameraWithoutTags) {
  device_.Allow(0);
  Start([this] { return OpenLive(watched_, lifter_, &device_); });
  Go();
  device_.AllowAndWait(1);
  WaitFor([](const auto& latest) { return latest.view.number == 1; });
  const auto frozen = session_->Freeze();
  ASSERT_TRUE(frozen);
  EXPECT_EQ(frozen->bgr.size(), cv::Size(64, 48));
  EXPECT_FALSE(frozen->pose);
  const cv::Mat copy = frozen->bgr.clone();
  device_.AllowAndWait(3);
  WaitFor([](const auto& latest) { return latest.view.number > 1; });
  EXPECT_EQ(cv::norm(copy, frozen->bgr, cv::NORM_INF), 0.0);
  session_.reset();
  EXPECT_EQ(device_.num_open(), 0);
}

TEST_F(LiveSessionTest, UnpluggedEndsWithAMessageAndAWholeVideo) {
  device_.num_frames = 20;
  device_.unplugged_at_end = true;
  Start([this] { return OpenLive(watched_, lifter_, &device_); });
  const fs::path dir = ScratchDir() / "recording";
  session_->Record(dir);
  Go();
  const auto end = WaitForEnd();
  EXPECT_THAT(end.status.message, HasSubstr("/dev/video0: is gone: unplugged"));
  EXPECT_EQ(end.status.recording_message, "");
  EXPECT_GE(end.status.num_recorded, 1);
  VideoFile video(dir / "video.mkv");
  int64_t num_frames = 0;
  while (video.Next()) ++num_frames;
  EXPECT_EQ(num_frames, end.status.num_recorded);
  EXPECT_EQ(device_.num_open(), 0);  // it can be opened again
}

TEST_F(LiveSessionTest, ABusyCameraIsSaid) {
  device_.errors[VIDIOC_STREAMON] = EBUSY;
  Start([this] { return OpenLive(watched_, lifter_, &device_); });
  Go();
  const auto end = WaitForEnd();
  EXPECT_THAT(end.status.message, HasSubstr("used by another program"));
  EXPECT_EQ(end.view.number, 0);
  EXPECT_FALSE(session_->Freeze());
}

TEST_F(LiveSessionTest, ARecordingEndsWhileTheCameraGoesOn) {
  device_.Allow(0);
  Start([this] { return OpenLive(watched_, lifter_, &device_); });
  const fs::path dir = ScratchDir() / "recording";
  session_->Record(dir);
  Go();
  device_.AllowAndWait(1);
  const auto recording = WaitFor([](const auto& latest) { return latest.view.number == 1; });
  EXPECT_EQ(recording.status.recording, dir);
  EXPECT_THAT(StatusLine(recording.status, recording.view), HasSubstr("1 recorded to"));
  session_->StopRecording();
  device_.AllowAndWait(2);
  const auto after = WaitFor([](const auto& latest) { return latest.view.number == 2; });
  EXPECT_TRUE(after.status.recording.empty());
  EXPECT_EQ(after.status.num_recorded, 1);
  EXPECT_EQ(after.status.state, State::kRunning);
  EXPECT_TRUE(VideoFile(dir / "video.mkv").Next());

  // A folder that has one is not written over.
  const std::string before = testing::FileText(dir / "video.mkv");
  session_->Record(dir);
  device_.AllowAndWait(3);
  const auto refused = WaitFor([](const auto& latest) { return latest.view.number == 3; });
  EXPECT_THAT(refused.status.recording_message, HasSubstr("found a recording"));
  EXPECT_EQ(refused.status.state, State::kRunning);
  EXPECT_EQ(testing::FileText(dir / "video.mkv"), before);
}

TEST_F(LiveSessionTest, FilesWithoutTagsHaveNothingToRecord) {
  sample_.tags.clear();
  sample_.view.camera.clear();
  Start([this] {
    LiveParts parts = OpenLive(sample_, lifter_);
    parts.source = std::make_unique<FirstFrames>(std::move(parts.source), 2);
    return parts;
  });
  session_->Record(ScratchDir() / "recording");
  Go();
  const auto end = WaitForEnd();
  EXPECT_THAT(end.status.recording_message, HasSubstr("found no tags to record"));
  EXPECT_EQ(end.status.message, "there are no more pictures");
  EXPECT_FALSE(fs::exists(ScratchDir() / "recording"));
}

TEST_F(LiveSessionTest, StopsWhileItWaitsForTheNextPicture) {
  const fs::path folder = ScratchDir() / "pictures";
  fs::create_directories(folder);
  for (const char* name : {"1.png", "2.png"}) WritePng(folder / name, testing::GreyRamp({64, 48}));
  LiveInputs slow;
  slow.view.input = folder;
  slow.view.folder_rate_hz = 0.0005;  // half an hour; the test has ten minutes
  Start([this, slow] { return OpenLive(slow, lifter_); });
  Go();
  const auto latest = WaitFor([](const auto& now) { return now.view.number == 1; });
  EXPECT_EQ(latest.view.number, 1);
  session_.reset();
}

TEST_F(LiveSessionTest, WhatCannotBeOpenedIsSaid) {
  sample_.tags = testing::WriteScratch("tags.toml", "family = 3");
  EXPECT_THROW(CheckFiles(sample_), InputError);
  Start([this] { return OpenLive(sample_, lifter_); });
  session_->Record(ScratchDir() / "recording");
  Go();
  const auto end = WaitForEnd();
  EXPECT_THAT(end.status.message, HasSubstr("tags.toml"));
  EXPECT_THAT(end.status.recording_message, HasSubstr("nothing was recorded"));
}

}  // namespace
}  // namespace poselift
