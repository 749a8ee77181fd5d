// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Frames of some bytes at planted times go into the ring; what it keeps is told by what it then
// writes to a real recording, or by its counts.
#include "src/io/frame_ring.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "src/io/video.h"
#include "src/io/video_recorder.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr size_t kBytes = 1000;

void PushFrames(int begin, int end, double rate_hz, FrameRing* ring) {
  for (int i = begin; i < end; ++i) ring->Push({i / rate_hz, std::vector<uint8_t>(kBytes)});
}

TEST(FrameRing, KeepsTheLastSeconds) {
  FrameRing ring({.length_s = 2.0});
  PushFrames(0, 10, 8.0, &ring);
  EXPECT_EQ(ring.num_frames(), 10u);
  PushFrames(10, 100, 8.0, &ring);
  EXPECT_EQ(ring.num_frames(), 17u);  // from 2 s before the last one on
  EXPECT_EQ(ring.num_bytes(), 17 * kBytes);
}

TEST(FrameRing, KeepsWithinItsBytes) {
  FrameRing ring({.length_s = 100.0, .max_bytes = 5 * kBytes + 1});
  PushFrames(0, 50, 8.0, &ring);
  EXPECT_EQ(ring.num_frames(), 5u);
  ring.Push({50.0, std::vector<uint8_t>(6 * kBytes)});
  EXPECT_EQ(ring.num_frames(), 0u);
  EXPECT_EQ(ring.num_bytes(), 0u);
}

TEST(FrameRing, StartsAnewWhenTheClockGoesBack) {
  FrameRing ring({.length_s = 2.0});
  PushFrames(80, 90, 8.0, &ring);
  PushFrames(0, 3, 8.0, &ring);
  EXPECT_EQ(ring.num_frames(), 3u);
  EXPECT_EQ(ring.num_bytes(), 3 * kBytes);
}

TEST(FrameRing, ComesBeforeWhatIsRecordedNext) {
  const auto path = testing::ScratchDir() / "a.mkv";
  const cv::Size size_px(32, 16);
  FrameRing ring({.length_s = 0.5});
  VideoRecorder recorder(path, size_px);
  for (int i = 0; i < 20; ++i) {
    JpegFrame frame{7.0 + i / 8.0, {}};
    cv::imencode(".jpg", cv::Mat(size_px, CV_8UC1, cv::Scalar(10 * i)), frame.bytes);
    if (i < 15) {
      ring.Push(std::move(frame));
      continue;
    }
    ring.FlushInto(&recorder);
    ASSERT_TRUE(recorder.Add(frame));
  }
  recorder.Close();
  EXPECT_EQ(ring.num_bytes(), 0u);
  VideoFile video(path);
  for (int i = 10; i < 20; ++i) {  // 0.5 s before frame 14, and the rest
    const auto frame = video.Next();
    ASSERT_TRUE(frame) << i;
    EXPECT_NEAR(frame->time_s, (i - 10) / 8.0, 1e-9);
    EXPECT_NEAR(cv::mean(frame->bgr)[0], 10.0 * i, 3.0);
  }
  EXPECT_FALSE(video.Next());
}

}  // namespace
}  // namespace poselift
