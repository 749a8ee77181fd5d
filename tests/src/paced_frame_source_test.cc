// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up source of frames, played at its own speed: that no frame comes before its time,
// and that a slow reader loses frames and is told so, holds however slow the machine is.
#include "src/capture/paced_frame_source.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace poselift {
namespace {

constexpr double kFrameTime_s = 0.01;

class CountingSource : public FrameSource {
 public:
  explicit CountingSource(int num_frames) : num_frames_(num_frames) {}
  cv::Size size_px() const override { return {4, 4}; }
  std::optional<VideoFrame> Next() override {
    if (next_ == num_frames_) return std::nullopt;
    VideoFrame frame{.index = next_, .time_s = next_ * kFrameTime_s};
    ++next_;
    return frame;
  }
  std::optional<double> Skip_s() override { return std::nullopt; }

 private:
  int num_frames_, next_ = 0;
};

double Now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(PacedFrameSourceTest, NoFrameComesBeforeItsTimeAndEachIsCounted) {
  PacedFrameSource source(std::make_unique<CountingSource>(10));
  EXPECT_EQ(source.size_px(), cv::Size(4, 4));
  double first_s = 0.0;
  int num_frames = 0;
  while (const auto frame = source.Next()) {
    if (num_frames == 0) first_s = frame->monotonic_s;
    EXPECT_NEAR(frame->monotonic_s - first_s, frame->time_s, 1e-9);
    EXPECT_GE(Now_s(), frame->monotonic_s - 1e-9);
    num_frames += 1 + frame->num_lost;
    EXPECT_EQ(frame->index + 1, num_frames);
  }
  EXPECT_LE(num_frames, 10);
}

TEST(PacedFrameSourceTest, ASlowReaderLosesFramesAndIsTold) {
  PacedFrameSource source(std::make_unique<CountingSource>(1000));
  ASSERT_TRUE(source.Next());
  std::this_thread::sleep_for(std::chrono::duration<double>(8 * kFrameTime_s));
  const auto late = source.Next();
  ASSERT_TRUE(late);
  EXPECT_GE(late->num_lost, 5);
  EXPECT_EQ(late->index, late->num_lost + 1);
}

TEST(PacedFrameSourceTest, FramesLostAtTheEndAreToldWithTheLast) {
  PacedFrameSource source(std::make_unique<CountingSource>(5));
  ASSERT_TRUE(source.Next());
  std::this_thread::sleep_for(std::chrono::duration<double>(20 * kFrameTime_s));
  const auto last = source.Next();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->index, 4);
  EXPECT_EQ(last->num_lost, 3);
  EXPECT_FALSE(source.Next());
}

// A picture every half hour; without Stop the test would run for longer than it may.
TEST(PacedFrameSourceTest, StopEndsTheWait) {
  class Slow : public CountingSource {
   public:
    Slow() : CountingSource(2) {}
    std::optional<VideoFrame> Next() override {
      auto frame = CountingSource::Next();
      if (frame) frame->time_s = 1800.0 * frame->index;
      return frame;
    }
  };
  PacedFrameSource source(std::make_unique<Slow>());
  ASSERT_TRUE(source.Next());
  std::thread stopper([&] { source.Stop(); });
  EXPECT_FALSE(source.Next());
  stopper.join();
}

}  // namespace
}  // namespace poselift
