// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The thread that takes frames from a made-up camera, whose frames come when the test allows
// them, so that which are dropped does not hang on time. Frame i is of grey i.
#include "src/capture/live_frame_source.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cmath>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "src/capture/fourcc.h"
#include "src/capture/open_frame_source.h"
#include "src/input_error.h"
#include "tests/support/fake_camera.h"
#include "tests/support/made_up_video.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::AsJpeg;
using testing::FakeBuffer;
using testing::FakeCamera;

class LiveFrameSourceTest : public ::testing::Test {
 protected:
  LiveFrameSourceTest() {
    camera_.formats = {{kFourccGrey, "grey", {{{32, 16}, {30.0}}}}};
    camera_.frame = [](int i) { return FakeBuffer{std::string(32 * 16, static_cast<char>(i))}; };
    options_.camera.wanted = {0, {32, 16}, 30.0};
    options_.pictures = Pictures::kGrey;
  }
  ~LiveFrameSourceTest() override {
    EXPECT_EQ(camera_.num_open(), 0);
    EXPECT_EQ(camera_.num_mapped(), 0);
  }

  static int NumberOf(const VideoFrame& frame) { return frame.grey.at<uchar>(8, 8); }

  FakeCamera camera_;
  LiveOptions options_;
};

TEST_F(LiveFrameSourceTest, GivesEveryFrameToAReaderThatKeepsUp) {
  camera_.Allow(0);
  LiveFrameSource source(camera_.path, options_, &camera_);
  EXPECT_EQ(source.size_px(), cv::Size(32, 16));
  for (int i = 0; i < 30; ++i) {
    camera_.Allow(i + 1);
    const auto frame = source.Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->index, i);
    EXPECT_EQ(NumberOf(*frame), i);
    EXPECT_NEAR(frame->time_s, i / 30.0, 1e-5);
    EXPECT_NEAR(frame->monotonic_s, 1000.0 + (i + 1) / 30.0, 1e-5);
    EXPECT_EQ(frame->num_lost, 0);
    EXPECT_TRUE(frame->bgr.empty());
    EXPECT_TRUE(frame->encoded.empty());
  }
  EXPECT_EQ(source.counts().given, 30);
  EXPECT_EQ(source.counts().num_missing(), 0);
}

TEST_F(LiveFrameSourceTest, DropsTheOldestOfASlowReader) {
  camera_.Allow(0);
  options_.max_waiting = 3;
  LiveFrameSource source(camera_.path, options_, &camera_);
  camera_.AllowAndWait(10);
  for (const int number : {7, 8, 9}) {
    const auto frame = source.Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(NumberOf(*frame), number);
    EXPECT_EQ(frame->num_lost, number == 7 ? 7 : 0);
  }
  camera_.AllowAndWait(12);
  EXPECT_EQ(NumberOf(source.Next().value()), 10);
  EXPECT_EQ(source.counts().dropped, 7);
  EXPECT_EQ(source.counts().given, 4);
}

TEST_F(LiveFrameSourceTest, CountsOfEveryKindAddUp) {
  camera_.Allow(0);
  camera_.frame = [](int i) {
    const int skipped = i >= 5 ? 4 : 0;
    FakeBuffer buffer{std::string(32 * 16, '\1'), static_cast<uint32_t>(1 + i + skipped)};
    if (i == 6) buffer.flags = V4L2_BUF_FLAG_ERROR;
    if (i == 7) buffer.bytes.resize(100);  // short
    return buffer;
  };
  LiveFrameSource source(camera_.path, options_, &camera_);
  camera_.AllowAndWait(4);  // two are dropped
  int num_lost = source.Next().value().num_lost;
  num_lost += source.Next().value().num_lost;
  camera_.AllowAndWait(6);
  num_lost += source.Next().value().num_lost;
  num_lost += source.Next().value().num_lost;
  camera_.AllowAndWait(9);
  num_lost += source.Next().value().num_lost;
  const CaptureCounts counts = source.counts();
  EXPECT_EQ(counts.given, 5);
  EXPECT_EQ(counts.dropped, 2);
  EXPECT_EQ(counts.lost, 4);
  EXPECT_EQ(counts.bad, 2);
  EXPECT_EQ(num_lost, counts.num_missing());
}

TEST_F(LiveFrameSourceTest, PassesOverAFrameToo) {
  camera_.Allow(1);
  LiveFrameSource source(camera_.path, options_, &camera_);
  EXPECT_NEAR(source.Skip_s().value(), 0.0, 1e-9);
  camera_.Allow(2);
  const auto frame = source.Next();
  EXPECT_EQ(frame.value().index, 1);
  EXPECT_EQ(NumberOf(*frame), 1);
}

TEST_F(LiveFrameSourceTest, GivesWhatWasTakenBeforeItWasUnplugged) {
  camera_.num_frames = 2;
  camera_.unplugged_at_end = true;
  LiveFrameSource source(camera_.path, options_, &camera_);
  EXPECT_EQ(NumberOf(source.Next().value()), 0);
  EXPECT_EQ(NumberOf(source.Next().value()), 1);
  for (int i = 0; i < 2; ++i) try {
      source.Next();
      ADD_FAILURE() << "read without complaint";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("/dev/video0: is gone: unplugged"),
                std::string::npos)
          << error.what();
    }
}

TEST_F(LiveFrameSourceTest, ComplainsOfASilentDriver) {
  camera_.num_frames = 1;
  LiveFrameSource source(camera_.path, options_, &camera_);
  EXPECT_TRUE(source.Next());
  try {
    source.Next();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("gave no picture for 5 s"), std::string::npos)
        << error.what();
  }
  EXPECT_NEAR(camera_.Now_s(), 1000.0 + 1.0 / 30.0 + 5.1, 0.2);
}

TEST_F(LiveFrameSourceTest, ComplainsOfADriverThatGivesOnlyBrokenFrames) {
  camera_.frame = [](int) { return FakeBuffer{std::string(100, 'z')}; };
  LiveFrameSource source(camera_.path, options_, &camera_);
  try {
    source.Next();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("100 bytes of 512"), std::string::npos)
        << error.what();
  }
  EXPECT_GE(source.counts().bad, 1);
}

TEST_F(LiveFrameSourceTest, RefusesOptionsThatMakeNoSense) {
  for (const auto& spoil : std::vector<std::function<void(LiveOptions*)>>{
           [](LiveOptions* o) { o->max_waiting = 0; }, [](LiveOptions* o) { o->patience_s = -1.0; },
           [](LiveOptions* o) { o->camera.num_buffers = 1; },
           [](LiveOptions* o) { o->camera.wanted.rate_hz = std::nan(""); },
           [](LiveOptions* o) { o->camera.wanted.size_px.width = 0; }}) {
    LiveOptions spoilt = options_;
    spoil(&spoilt);
    EXPECT_THROW(LiveFrameSource(camera_.path, spoilt, &camera_), InputError);
  }
}

TEST_F(LiveFrameSourceTest, StopsAReaderThatWaits) {
  camera_.Allow(1);
  LiveFrameSource source(camera_.path, options_, &camera_);
  EXPECT_TRUE(source.Next());
  std::thread stopper([&] { source.Stop(); });
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.Skip_s());
  stopper.join();
}

TEST_F(LiveFrameSourceTest, MayBeCountedWhileItRuns) {
  LiveFrameSource source(camera_.path, options_, &camera_);
  std::thread counter([&] {
    while (source.counts().given < 200) std::this_thread::yield();
  });
  for (int i = 0; i < 200; ++i) EXPECT_TRUE(source.Next());
  counter.join();
}

TEST_F(LiveFrameSourceTest, KeepsTheBytesAndGivesColours) {
  const cv::Mat picture(16, 32, CV_8UC3, cv::Scalar(200, 100, 50));
  camera_.formats.front().fourcc = kFourccMjpg;
  camera_.frame = [&](int) { return FakeBuffer{AsJpeg(picture)}; };
  options_.keep_encoded = true;
  options_.pictures = Pictures::kBoth;
  LiveFrameSource source(camera_.path, options_, &camera_);
  const auto frame = source.Next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->fourcc, kFourccMjpg);
  EXPECT_EQ(cv::norm(cv::imdecode(frame->encoded, cv::IMREAD_COLOR), frame->bgr, cv::NORM_INF),
            0.0);
  EXPECT_LE(cv::norm(frame->bgr, picture, cv::NORM_INF), 4.0);
  EXPECT_EQ(frame->grey.type(), CV_8UC1);
}

// Damaged frames among good ones never end the source, nor reach the reader.
TEST_F(LiveFrameSourceTest, PassesOverCorruptJpeg) {
  auto rng = testing::TestRng();
  const std::string jpeg = AsJpeg(testing::Texture({32, 16}, &rng));
  camera_.formats.front().fourcc = kFourccMjpg;
  camera_.Allow(0);
  camera_.frame = [&](int i) {
    FakeBuffer buffer{jpeg};
    if (i % 3 == 1) buffer.bytes.resize(jpeg.size() / 2);
    if (i % 3 == 2) buffer.bytes = "no JPEG at all";
    return buffer;
  };
  LiveFrameSource source(camera_.path, options_, &camera_);
  for (int i = 0; i < 40; ++i) {
    camera_.AllowAndWait(3 * i + 1);  // the two broken ones before it are taken
    const auto frame = source.Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->grey.size(), cv::Size(32, 16));
    EXPECT_EQ(frame->num_lost, i == 0 ? 0 : 2);
  }
}

TEST(OpenFrameSource, TellsWhatANameMeans) {
  const std::filesystem::path folder = testing::ScratchDir();
  cv::imwrite(folder / "a.png", cv::Mat(16, 32, CV_8UC3, cv::Scalar::all(7)));
  testing::WriteVideo(folder / "a.mp4", {cv::Mat(16, 32, CV_8UC3, cv::Scalar::all(7))}, 25.0);
  EXPECT_EQ(KindOfSource("/dev/video3"), SourceKind::kCamera);
  EXPECT_EQ(KindOfSource("/dev/v4l/by-id/usb-Cam-index0"), SourceKind::kCamera);
  EXPECT_EQ(KindOfSource("0"), SourceKind::kCamera);
  EXPECT_EQ(DevicePath("12"), "/dev/video12");
  EXPECT_EQ(DevicePath("/dev/video3"), "/dev/video3");
  EXPECT_EQ(KindOfSource(folder), SourceKind::kFolder);
  EXPECT_EQ(KindOfSource(folder / "a.png"), SourceKind::kImage);
  EXPECT_EQ(KindOfSource(folder / "a.mp4"), SourceKind::kVideo);
  EXPECT_THROW(KindOfSource(folder / "absent.mp4"), InputError);
  for (const std::string name : {folder / "a.png", folder / "a.mp4", folder}) {
    FrameSourceOptions options;
    options.pictures = Pictures::kGrey;
    const auto source = OpenFrameSource(name, options);
    const auto frame = source->Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->grey.size(), cv::Size(32, 16));
    EXPECT_TRUE(frame->bgr.empty());
    EXPECT_FALSE(source->Next());
  }
}

TEST_F(LiveFrameSourceTest, IsOpenedByItsName) {
  FrameSourceOptions options;
  options.pictures = Pictures::kBoth;
  options.live = options_;
  const auto source = OpenFrameSource("0", options, &camera_);
  EXPECT_EQ(source->Next().value().bgr.size(), cv::Size(32, 16));
  EXPECT_NE(dynamic_cast<LiveFrameSource*>(source.get()), nullptr);
}

}  // namespace
}  // namespace poselift
