// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Recordings of planted pictures at planted times, read back with our own reader and, where it is
// there, with ffprobe. Real: a child that records and is killed at random moments, files that are
// cut at any byte, a device that is full, a file that may not grow. Frame i is grey of brightness
// 10 + 5 i, so that each tells which it is.
#include "src/io/video_recorder.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "src/input_error.h"
#include "src/io/video.h"
#include "tests/support/child.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::Child;
using testing::FileText;
using testing::ScratchDir;
using testing::WriteScratch;

const cv::Size kSize_px(96, 64);

JpegFrame Frame(int i, double time_s) {
  cv::Mat picture(kSize_px, CV_8UC3, cv::Scalar::all(10 + 5 * (i % 48)));
  picture(cv::Rect(0, 0, 24, 16)).setTo(cv::Scalar(0, 255, 255));
  JpegFrame frame{time_s, {}};
  cv::imencode(".jpg", picture, frame.bytes);
  return frame;
}

std::vector<JpegFrame> EvenFrames(int count) {
  std::vector<JpegFrame> frames;
  for (int i = 0; i < count; ++i) frames.push_back(Frame(i, 1234.5 + i / 25.0));
  return frames;
}

int NumberOf(const cv::Mat& bgr) {
  return cvRound((cv::mean(bgr(cv::Rect(40, 30, 8, 8)))[0] - 10.0) / 5.0);
}

// Frames in order from the first one on, each the right picture at the right time.
int CountFrames(const fs::path& path, const std::vector<JpegFrame>& written) {
  VideoFile video(path);
  int count = 0;
  for (; const auto frame = video.Next(); ++count) {
    const auto i = static_cast<size_t>(count);
    EXPECT_LT(i, written.size());
    EXPECT_EQ(NumberOf(frame->bgr), count % 48);
    EXPECT_NEAR(frame->time_s, written[i].time_s - written[0].time_s, 0.5001e-3) << count;
  }
  return count;
}

void Record(const std::vector<JpegFrame>& frames, const fs::path& path) {
  VideoRecorder recorder(path, kSize_px);
  for (const JpegFrame& frame : frames) EXPECT_TRUE(recorder.Add(frame));
  EXPECT_EQ(recorder.num_frames(), static_cast<int>(frames.size()));
  recorder.Close();
}

std::string Complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no complaint)";
}

TEST(VideoRecorder, GivesBackPicturesAndUnevenTimes) {
  const fs::path path = ScratchDir() / "a.mkv";
  std::vector<JpegFrame> frames;
  double time_s = 5000.25;
  auto rng = testing::TestRng();
  for (int i = 0; i < 60; ++i) {
    frames.push_back(Frame(i, time_s));
    time_s += std::uniform_real_distribution(0.002, 0.2)(rng);
  }
  Record(frames, path);
  EXPECT_EQ(CountFrames(path, frames), 60);
  const cv::Mat yellow = VideoFile(path).Next()->bgr(cv::Rect(4, 4, 12, 8));
  EXPECT_LT(cv::norm(cv::mean(yellow), cv::Scalar(0, 255, 255)), 12.0);
  const std::string file = FileText(path);
  for (const JpegFrame& frame : frames)
    EXPECT_NE(file.find(std::string(frame.bytes.begin(), frame.bytes.end())), std::string::npos);
}

// A camera in the dark, or one that hangs for a minute.
TEST(VideoRecorder, KeepsGapsAndChangesOfRate) {
  const fs::path path = ScratchDir() / "a.mkv";
  std::vector<JpegFrame> frames;
  double time_s = 0.0;
  for (int i = 0; i < 90; ++i) {
    frames.push_back(Frame(i, time_s));
    time_s += i < 60 ? 1.0 / 60.0 : i == 60 ? 90.0 : 1.0;
  }
  Record(frames, path);
  EXPECT_EQ(CountFrames(path, frames), 90);
}

TEST(VideoRecorder, RefusesTimesThatDoNotGrow) {
  const fs::path path = ScratchDir() / "a.mkv";
  VideoRecorder recorder(path, kSize_px);
  const std::vector<JpegFrame> good = {Frame(0, 3.0), Frame(1, 3.04), Frame(2, 3.08)};
  EXPECT_FALSE(recorder.Add(Frame(9, std::nan(""))));
  EXPECT_TRUE(recorder.Add(good[0]));
  EXPECT_FALSE(recorder.Add(Frame(9, 3.0)));
  EXPECT_TRUE(recorder.Add(good[1]));
  EXPECT_FALSE(recorder.Add(Frame(9, 3.0402)));
  EXPECT_FALSE(recorder.Add(Frame(9, -2.0)));
  EXPECT_FALSE(recorder.Add({3.06, {}}));
  EXPECT_TRUE(recorder.Add(good[2]));
  EXPECT_EQ(recorder.num_frames(), 3);
  recorder.Close();
  recorder.Close();
  EXPECT_THROW(recorder.Add(Frame(3, 4.0)), std::logic_error);
  EXPECT_EQ(CountFrames(path, good), 3);
}

TEST(VideoRecorder, SameFramesGiveTheSameBytes) {
  const fs::path folder = ScratchDir();
  Record(EvenFrames(5), folder / "a.mkv");
  Record(EvenFrames(5), folder / "b:c.mkv");
  EXPECT_EQ(FileText(folder / "a.mkv"), FileText(folder / "b:c.mkv"));
}

TEST(VideoRecorder, IsReadWhileItGrows) {
  const fs::path path = ScratchDir() / "a.mkv";
  const auto frames = EvenFrames(12);
  VideoRecorder recorder(path, kSize_px);
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(recorder.Add(frames[static_cast<size_t>(i)]));
    EXPECT_EQ(CountFrames(path, frames), i + 1);
  }
}

// However far the last frame got: those before it are there.
TEST(VideoRecorder, CutAnywhereHasAllFramesBefore) {
  const fs::path path = ScratchDir() / "a.mkv";
  const auto frames = EvenFrames(8);
  std::vector<size_t> ends;
  std::string grown;
  {
    VideoRecorder recorder(path, kSize_px);
    for (const JpegFrame& frame : frames) {
      ASSERT_TRUE(recorder.Add(frame));
      ends.push_back(fs::file_size(path));
    }
    grown = FileText(path);
  }
  for (size_t length = ends[5]; length <= ends[7]; length += length < ends[6] ? 1 : 17) {
    const std::string cut = WriteScratch("cut.mkv", grown.substr(0, length));
    const int found = CountFrames(cut, frames);
    const int whole = length < ends[6] ? 6 : length < ends[7] ? 7 : 8;
    // A decoder may show a part of the one that is cut.
    EXPECT_GE(found, whole) << length;
    EXPECT_LE(found, whole + 1) << length;
  }
}

// Every second frame comes damaged from the camera, as far as JpegEncoder lets it through.
TEST(VideoRecorder, DamagedFramesLeaveTheGoodOnes) {
  const fs::path path = ScratchDir() / "a.mkv";
  auto rng = testing::TestRng();
  const JpegFrame source = Frame(3, 0.0);
  const auto damaged =
      testing::DamagedCopies({source.bytes.begin(), source.bytes.end()}, 300, &rng);
  JpegEncoder encoder({V4L2_PIX_FMT_MJPEG, kSize_px});
  VideoRecorder recorder(path, kSize_px);
  const int num_good = static_cast<int>(damaged.size());
  int num_damaged = 0;
  for (int i = 0; i < num_good; ++i) {
    ASSERT_TRUE(recorder.Add(Frame(i, 0.04 * i)));
    const std::string& copy = damaged[static_cast<size_t>(i)];
    JpegFrame frame{0.04 * i + 0.02, {}};
    if (encoder.Encode({reinterpret_cast<const uint8_t*>(copy.data()), copy.size()}, &frame.bytes))
      num_damaged += recorder.Add(frame) ? 1 : 0;
  }
  EXPECT_GT(num_damaged, 100);
  recorder.Close();
  VideoFile video(path);
  int next = 0;
  while (const auto frame = video.Next()) {
    if (cvRound(frame->time_s * 1000.0) != 40 * next) continue;
    EXPECT_EQ(NumberOf(frame->bgr), next % 48);
    ++next;
  }
  EXPECT_EQ(next, num_good);
}

TEST(VideoRecorder, KilledLosesNoFrameThatWasAdded) {
  const fs::path path = ScratchDir() / "a.mkv";
  const auto frames = EvenFrames(3000);
  auto rng = testing::TestRng();
  for (int trial = 0; trial < 12; ++trial) {
    const Child child([&](Child::Shared* shared) {
      VideoRecorder recorder(path, kSize_px);
      for (const JpegFrame& frame : frames) {
        recorder.Add(frame);
        ++shared->added;
        ::usleep(50);
      }
      ::pause();
    });
    while (child.shared().added < 2) ::usleep(100);
    ::usleep(static_cast<useconds_t>(rng() % 60000));
    child.Kill();
    ASSERT_TRUE(WIFSIGNALED(child.Wait()));
    const int added = child.shared().added;
    const int found = CountFrames(path, frames);
    EXPECT_GE(found, added);
    EXPECT_LE(found, added + 1);
  }
}

TEST(VideoRecorder, EndsWithTheLastGoodFrameWhenTheFileMayNotGrow) {
  const fs::path path = ScratchDir() / "a.mkv";
  const auto frames = EvenFrames(200);
  for (const rlim_t limit : {20000u, 20500u, 21111u, 33333u}) {
    const Child child([&](Child::Shared* shared) {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit bytes{limit, limit};
      ::setrlimit(RLIMIT_FSIZE, &bytes);
      const std::string complaint = Complaint([&] {
        VideoRecorder recorder(path, kSize_px);
        for (const JpegFrame& frame : frames) {
          recorder.Add(frame);
          ++shared->added;
        }
      });
      complaint.copy(shared->complaint, sizeof shared->complaint - 1);
    });
    ASSERT_EQ(child.Wait(), 0);
    const int added = child.shared().added;
    EXPECT_GT(added, 5);
    EXPECT_LT(added, 200);
    const std::string complaint = child.shared().complaint;
    EXPECT_NE(complaint.find(path.string()), std::string::npos) << complaint;
    EXPECT_NE(complaint.find("File too large"), std::string::npos) << complaint;
    EXPECT_NE(complaint.find("after " + std::to_string(added) + " frames"), std::string::npos)
        << complaint;
    EXPECT_EQ(CountFrames(path, frames), added);
  }
}

TEST(VideoRecorder, SaysWhyAFileCannotBeWritten) {
  const fs::path folder = ScratchDir();
  const auto opening = [](const fs::path& path) {
    return Complaint([&] { VideoRecorder(path, kSize_px); });
  };
  ::testing::internal::CaptureStderr();
  EXPECT_NE(opening("/dev/full").find("/dev/full: cannot be written any further: No space left"),
            std::string::npos)
      << opening("/dev/full");
  const std::string absent = (folder / "no" / "a.mkv").string();
  EXPECT_EQ(opening(absent), absent + ": cannot be recorded to: No such file or directory");
  EXPECT_EQ(opening(folder), folder.string() + ": cannot be recorded to: Is a directory");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THROW(VideoRecorder(folder / "a.mkv", {}), std::invalid_argument);
}

TEST(VideoRecorder, IsReadByFfprobe) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffprobe";
  const fs::path path = ScratchDir() / "a.mkv";
  auto frames = EvenFrames(30);
  frames[29].time_s += 0.5;
  std::string whole;
  {
    VideoRecorder recorder(path, kSize_px);
    for (const JpegFrame& frame : frames) recorder.Add(frame);
    whole = FileText(path);
  }
  // As it is after Close, and as a program leaves it that is killed.
  for (const std::string& file : {path.string(), WriteScratch("killed.mkv", whole)}) {
    const std::string command =
        "ffprobe -v warning -count_frames -show_entries stream=codec_name,nb_read_frames:"
        "frame=pts_time -of csv=p=0 '" +
        file + "' 2>&1";
    FILE* pipe = ::popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string text, wanted;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
    EXPECT_EQ(::pclose(pipe), 0);
    char line[32];
    for (const JpegFrame& frame : frames) {
      std::snprintf(line, sizeof line, "%.6f\n", frame.time_s - frames[0].time_s);
      wanted += line;
    }
    EXPECT_EQ(text, wanted + "mjpeg,30\n");
  }
}

}  // namespace
}  // namespace poselift
