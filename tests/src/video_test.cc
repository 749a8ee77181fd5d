// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Videos are written here with OpenCV's encoders: frame i is grey of brightness
// 10 + 12 i with a white corner, so that each tells which it is and how it is
// turned. Uneven times and a turn are planted in the boxes of an MP4. Files that
// are cut short, empty or garbage must be refused, and nothing may reach stderr.
#include "src/io/video.h"

#include <gtest/gtest.h>

#include "src/input_error.h"
#include "src/io/video_container.h"
#include "tests/support/made_up_video.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::FileText;
using testing::ScratchDir;
using testing::WriteScratch;
using testing::WriteVideo;

constexpr int kNumFrames = 20;
constexpr double kRate_hz = 25.0;
const cv::Size kSize_px(96, 64);

std::vector<cv::Mat> NumberedFrames() {
  std::vector<cv::Mat> frames;
  for (int i = 0; i < kNumFrames; ++i) {
    frames.emplace_back(kSize_px, CV_8UC3, cv::Scalar::all(10 + 12 * i));
    frames.back()(cv::Rect(0, 0, 24, 16)).setTo(cv::Scalar::all(255));
  }
  return frames;
}

// A file in a fresh folder.
fs::path NumberedVideo(const std::string& name) {
  fs::path path = ScratchDir() / name;
  WriteVideo(path, NumberedFrames(), kRate_hz);
  return path;
}

int NumberOf(const cv::Mat& picture) {
  const cv::Rect middle(picture.cols / 2 - 4, picture.rows / 2 - 4, 8, 8);
  return cvRound((cv::mean(picture(middle))[0] - 10.0) / 12.0);
}

std::vector<VideoFrame> ReadAll(const fs::path& path) {
  VideoFile video(path);
  std::vector<VideoFrame> frames;
  while (auto frame = video.Next()) frames.push_back(std::move(*frame));
  return frames;
}

std::string Complaint(const fs::path& path) {
  try {
    ReadAll(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(read without complaint)";
}

class VideoOfKind : public ::testing::TestWithParam<const char*> {};

TEST_P(VideoOfKind, GivesAllFramesInOrderWithTheirTimes) {
  const fs::path path = NumberedVideo(GetParam());
  EXPECT_EQ(VideoFile(path).size_px(), kSize_px);
  const auto frames = ReadAll(path);
  ASSERT_EQ(frames.size(), size_t{kNumFrames});
  for (int i = 0; i < kNumFrames; ++i) {
    const VideoFrame& frame = frames[static_cast<size_t>(i)];
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(NumberOf(frame.bgr), i);
    EXPECT_NEAR(frame.time_s, i / kRate_hz, 1e-6);
    EXPECT_EQ(frame.bgr.size(), kSize_px);
  }
}

TEST_P(VideoOfKind, SkipsToTheSameFrames) {
  const fs::path path = NumberedVideo(GetParam());
  VideoFile video(path);
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(video.Skip_s().value(), i / kRate_hz, 1e-6);
  const auto frame = video.Next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->index, 7);
  EXPECT_EQ(NumberOf(frame->bgr), 7);
  EXPECT_NEAR(frame->time_s, 7 / kRate_hz, 1e-6);
}

TEST_P(VideoOfKind, IsRefusedWhereverItIsCut) {
  const fs::path path = NumberedVideo(GetParam());
  const std::string whole = FileText(path);
  for (size_t part = 1; part < 20; ++part) {
    const std::string cut = WriteScratch(GetParam(), whole.substr(0, whole.size() * part / 20));
    EXPECT_NE(Complaint(cut).find(GetParam()), std::string::npos) << part;
  }
  EXPECT_NE(
      Complaint(WriteScratch(GetParam(), whole.substr(0, whole.size() - 40))).find("cut short"),
      std::string::npos);
}

// Whatever happens to bytes inside: an InputError, or frames at growing times.
TEST_P(VideoOfKind, SurvivesDamage) {
  const fs::path path = NumberedVideo(GetParam());
  const std::string whole = FileText(path);
  auto rng = testing::TestRng();
  for (int trial = 0; trial < 60; ++trial) {
    std::string damaged = whole;
    for (int i = 0; i < 8; ++i) damaged[rng() % whole.size()] = static_cast<char>(rng());
    try {
      double last_s = -1.0;
      for (const VideoFrame& frame : ReadAll(WriteScratch(GetParam(), damaged))) {
        EXPECT_GT(frame.time_s, last_s);
        last_s = frame.time_s;
      }
    } catch (const InputError&) {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, VideoOfKind, ::testing::Values("a.avi", "a.mp4"),
                         [](const auto& kind) { return std::string(kind.param).substr(2); });

TEST(Video, TimesAreThoseOfTheFileNotOfARate) {
  const std::string even = FileText(NumberedVideo("even.mp4"));
  std::vector<double> durations;
  for (int i = 0; i < kNumFrames; ++i)
    durations.push_back(i % 3 == 0 ? 0.5 : i % 3 == 1 ? 1.5 : 1.0);
  const std::string path = WriteScratch("uneven.mp4", testing::WithFrameDurations(even, durations));
  const std::vector<double> times_s = ReadFrameTimes(path);
  ASSERT_EQ(times_s.size(), size_t{kNumFrames});
  double time_s = 0.0;
  for (size_t i = 0; i < times_s.size(); ++i) {
    EXPECT_NEAR(times_s[i], time_s, 1e-4) << i;
    time_s += durations[i] / kRate_hz;
  }
}

TEST(Video, IsTurnedUpright) {
  const std::string lying = FileText(NumberedVideo("lying.mp4"));
  const std::string path = WriteScratch("turned.mp4", testing::TurnedClockwise(lying));
  EXPECT_EQ(VideoFile(path).size_px(), cv::Size(kSize_px.height, kSize_px.width));
  const auto frames = ReadAll(path);
  ASSERT_EQ(frames.size(), size_t{kNumFrames});
  EXPECT_EQ(NumberOf(frames[3].bgr), 3);
  const auto corner = [&](int x, int y) { return frames[3].bgr.at<cv::Vec3b>(y, x)[0]; };
  EXPECT_GT(corner(kSize_px.height - 5, 5), 200);  // the white one, top left before
  EXPECT_LT(corner(5, 5), 100);
}

TEST(Video, RefusesWhatIsNone) {
  const fs::path folder = ScratchDir();
  EXPECT_NE(Complaint(folder / "absent.mp4").find("no such file"), std::string::npos);
  EXPECT_NE(Complaint(folder).find("is a folder"), std::string::npos);
  EXPECT_NE(Complaint(WriteScratch("empty.mp4", "")).find("is empty"), std::string::npos);
  EXPECT_NE(Complaint(WriteScratch("text.mp4", "Once upon a time")).find("is no video"),
            std::string::npos);
}

TEST(Video, IsSilentOnStderr) {
  const std::string whole = FileText(NumberedVideo("a.mp4"));
  std::string damaged = whole;
  for (size_t i = 200; i + 800 < whole.size(); i += 3) damaged[i] = '\x55';
  ::testing::internal::CaptureStderr();
  Complaint(WriteScratch("text.mp4", "Once upon a time"));
  Complaint(WriteScratch("damaged.mp4", damaged));
  Complaint(WriteScratch("cut.mp4", whole.substr(0, whole.size() / 2)));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Video, IsToldByItsFirstBytes) {
  EXPECT_TRUE(IsVideo(FileText(NumberedVideo("a.avi"))));
  EXPECT_TRUE(IsVideo(FileText(NumberedVideo("a.mp4"))));
  EXPECT_TRUE(IsVideo("\x1a\x45\xdf\xa3 webm"));
  EXPECT_FALSE(IsVideo(""));
  EXPECT_FALSE(IsVideo("{\"format\": \"poselift-labels\"}"));
  EXPECT_FALSE(IsVideo(std::string("\0\0\0\x18", 4) + "ftypavif"));
  EXPECT_FALSE(IsVideo("RIFF\1\1\1\1WEBP"));
}

TEST(VideoContainer, SaysHowMuchOfMatroskaIsMissing) {
  // EBML head of 2 bytes, segment of 16 bytes, of which 10 are there.
  const std::string head = "\x1a\x45\xdf\xa3\x82zz\x18\x53\x80\x67\x90";
  EXPECT_EQ(MissingBytes(WriteScratch("a.mkv", head + std::string(10, 'z'))), 6u);
  EXPECT_EQ(MissingBytes(WriteScratch("a.mkv", head + std::string(16, 'z'))), 0u);
  const std::string live = "\x1a\x45\xdf\xa3\x82zz\x18\x53\x80\x67\xff";
  EXPECT_EQ(MissingBytes(WriteScratch("a.mkv", live + std::string(10, 'z'))), 0u);
}

TEST(Video, OfARealCameraIsRead) {
  POSELIFT_DATA_OR_SKIP(data);
  const fs::path path = data / "photos" / "walk-side.mp4";
  if (!fs::exists(path)) GTEST_SKIP() << "real video absent: " << path;
  const std::vector<double> times_s = ReadFrameTimes(path);
  ASSERT_EQ(times_s.size(), 230u);
  for (size_t i = 0; i < times_s.size(); ++i)
    EXPECT_NEAR(times_s[i], static_cast<double>(i) / 30.0, 1e-3);
}

}  // namespace
}  // namespace poselift
