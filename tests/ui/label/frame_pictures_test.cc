// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sample clip, whose frames are read in any order, and a sample picture. Made up: videos
// of many key frames, by OpenCV's encoders and, where the program is there, by FFmpeg's: H.264 with
// B-frames, with frames before a key frame that need the one before it, with uneven times, and what
// else people have. Checked against the video read from its beginning to its end, bit by bit.
#include "ui/label/frame_pictures.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <opencv2/core.hpp>

#include "src/input_error.h"
#include "src/io/image.h"
#include "tests/support/made_up_video.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"
#include "ui/label/label_inputs.h"
#include "ui/label/label_project.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::SourcePath;

FrameLabels FrameOfClip(int index) { return {.image = "clip.mp4", .frame = index}; }

bool AreSame(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(FramePictures, GivesFramesOfAVideoInAnyOrder) {
  std::vector<cv::Mat> all;
  VideoFile clip(SourcePath("samples/tags/clip.mp4"));
  while (const auto frame = clip.Next()) all.push_back(frame->bgr);
  FramePictures pictures(SourcePath("samples/tags"));
  for (const int index : {3, 4, 20, 19, 3, 89, 0})
    EXPECT_TRUE(AreSame(pictures.Read(FrameOfClip(index)), all.at(static_cast<size_t>(index))))
        << index;
  EXPECT_THROW(pictures.Read(FrameOfClip(static_cast<int>(all.size()))), InputError);
  EXPECT_TRUE(AreSame(pictures.Read(FrameOfClip(5)), all[5]));
}

std::vector<cv::Mat> AllFrames(const fs::path& path) {
  std::vector<cv::Mat> all;
  VideoFile video(path);
  while (const auto frame = video.Next()) all.push_back(frame->bgr);
  return all;
}

// Far and near, forwards and back, and the last ones.
void ExpectAnyOrder(const fs::path& path, int least_seeks) {
  const std::vector<cv::Mat> all = AllFrames(path);
  const int last = static_cast<int>(all.size()) - 1;
  ASSERT_GE(last, 150);
  FramePictures pictures(path.parent_path());
  const auto expect = [&](int index) {
    const FrameLabels frame{.image = path.filename().string(), .frame = index};
    EXPECT_TRUE(AreSame(pictures.Read(frame), all[static_cast<size_t>(index)]))
        << path << " " << index;
  };
  expect(0);
  pictures.WaitForTimes();
  for (const int index : {140, 60, 61, 59, 58, 130, 0, last, last - 1, 75, last - 3, 49, 120, 89})
    expect(index);
  auto rng = testing::TestRng();
  for (int i = 0; i < 12; ++i) expect(static_cast<int>(rng() % all.size()));
  for (int index = 100; index > 70; --index) expect(index);
  for (int index = last - 20; index <= last; ++index) expect(index);
  EXPECT_GE(pictures.num_seeks(), least_seeks) << path;
  EXPECT_THROW(pictures.Read({.image = path.filename().string(), .frame = last + 1}), InputError);
}

std::vector<cv::Mat> MovingTexture(int num_frames) {
  auto rng = testing::TestRng();
  const cv::Mat texture = testing::Texture({320, 96}, &rng);
  std::vector<cv::Mat> frames;
  for (int f = 0; f < num_frames; ++f)
    frames.push_back(texture(cv::Rect(f % 200, 0, 96, 96)).clone());
  return frames;
}

TEST(FramePictures, AVideoOfManyKeyFramesIsReadInAnyOrder) {
  for (const char* name : {"even.avi", "even.mp4"}) {
    testing::WriteVideo(testing::ScratchDir() / name, MovingTexture(160), 30.0);
    ExpectAnyOrder(testing::ScratchDir() / name, 5);
  }
}

TEST(FramePictures, AVideoOfUnevenTimesIsReadInAnyOrder) {
  const fs::path file = testing::ScratchDir() / "even.mp4";
  testing::WriteVideo(file, MovingTexture(160), 30.0);
  std::vector<double> durations;
  for (int f = 0; f < 80; ++f) durations.insert(durations.end(), {f < 40 ? 1.7 : 0.4, 0.5});
  durations.back() += 160.0 - std::accumulate(durations.begin(), durations.end(), 0.0);
  const std::string text = testing::FileText(file);
  const fs::path uneven =
      testing::WriteScratch("uneven.mp4", testing::WithFrameDurations(text, durations));
  ExpectAnyOrder(uneven, 3);
}

// Who is stopped on the way to a far frame may go to any other.
TEST(FramePictures, AFrameIsReadInPartsWhenAnotherOneIsWantedMeanwhile) {
  const fs::path file = testing::ScratchDir() / "stopped.mp4";
  testing::WriteVideo(file, MovingTexture(160), 30.0);
  const std::vector<cv::Mat> all = AllFrames(file);
  FramePictures pictures(file.parent_path());
  const auto frame_of = [&](int index) {
    return FrameLabels{.image = file.filename().string(), .frame = index};
  };
  struct Stopped {};
  for (const int wanted : {159, 80, 0, 100, 90}) {
    double before = 0.0;
    const auto stop = [&](double fraction) {
      EXPECT_GE(fraction, before);
      EXPECT_LE(fraction, 1.0);
      before = fraction;
      if (fraction >= 0.5) throw Stopped();
    };
    try {
      pictures.Read(frame_of(wanted), stop);  // what was kept is there at once
    } catch (const Stopped&) {
    }
    const int other = (wanted + 70) % 160;
    EXPECT_TRUE(AreSame(pictures.Read(frame_of(other)), all[static_cast<size_t>(other)])) << other;
    EXPECT_TRUE(AreSame(pictures.Read(frame_of(wanted)), all[static_cast<size_t>(wanted)]))
        << wanted;
  }
}

struct Kind {
  std::string name, ending, how;
  int least_seeks;
};

class VideoOfMaker : public ::testing::TestWithParam<Kind> {};

TEST_P(VideoOfMaker, IsReadInAnyOrder) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no program ffmpeg to make videos with";
  const fs::path file = testing::ScratchDir() / (GetParam().name + GetParam().ending);
  const std::string command =
      "ffmpeg -loglevel quiet -y -f lavfi -i testsrc2=s=128x96:r=30:d=6 -pix_fmt yuv420p " +
      GetParam().how + " " + file.string();
  if (std::system(command.c_str()) != 0) GTEST_SKIP() << "ffmpeg cannot: " << command;
  ExpectAnyOrder(file, GetParam().least_seeks);
}

const std::string kUneven =
    "-vf \"setpts='(N+0.4*mod(N\\,3)+if(gt(N\\,80)\\,60\\,0))/30/TB'\" -fps_mode passthrough ";

INSTANTIATE_TEST_SUITE_P(
    Makers, VideoOfMaker,
    ::testing::Values(
        Kind{"BFrames", ".mp4", "-c:v libx264 -g 25 -bf 3 -preset fast", 5},
        Kind{"OpenGop", ".mp4", "-c:v libx264 -g 25 -bf 3 -x264-params open-gop=1:scenecut=0", 5},
        Kind{"Refresh", ".mp4", "-c:v libx264 -g 30 -x264-params intra-refresh=1", 5},
        Kind{"Uneven", ".mp4", kUneven + "-c:v libx264 -g 25 -bf 2", 5},
        Kind{"Uneven", ".mkv", kUneven + "-c:v libx264 -g 25 -bf 2", 5},
        Kind{"OneKey", ".mp4", "-c:v libx264 -g 1000 -bf 2", 5},
        Kind{"H265", ".mp4", "-c:v libx265 -g 25 -x265-params log-level=none", 5},
        Kind{"Mpeg4", ".avi", "-c:v mpeg4 -g 25 -bf 2", 5},
        Kind{"Mpeg2", ".mpg", "-c:v mpeg2video -g 15 -bf 2", 5},
        Kind{"Vp9", ".webm", "-c:v libvpx-vp9 -g 40 -deadline realtime -cpu-used 8", 5},
        Kind{"MotionJpeg", ".mov", "-c:v mjpeg", 5}),
    [](const auto& kind) { return kind.param.name + kind.param.ending.substr(1); });

TEST(FramePictures, ReadsPicturesAndKnowsFramesWithoutOne) {
  FramePictures pictures(SourcePath("samples/photo"));
  EXPECT_TRUE(AreSame(pictures.Read({.image = "kick.jpg"}),
                      ReadImage(SourcePath("samples/photo/kick.jpg"))));
  EXPECT_TRUE(pictures.Read({}).empty());
  EXPECT_THROW(pictures.Read({.image = "none.jpg"}), InputError);
}

TEST(LabelInputs, AVideoBecomesAFrameForEachOfItsFrames) {
  const fs::path file = testing::ScratchDir() / "new" / "clip.labels.json";
  fs::remove_all(file.parent_path());
  const std::string clip = SourcePath("samples/tags/clip.mp4").string();
  EXPECT_EQ(FindLabelsFile({clip}, file.string(), "body15"), file);
  LabelProject project(file);
  const auto& frames = project.labels().frames;
  ASSERT_EQ(frames.size(), 90U);
  EXPECT_EQ(frames[7].frame, 7);
  EXPECT_NEAR(*frames[7].time_s, 7 / 30.0, 1e-3);
  EXPECT_EQ(fs::weakly_canonical(project.dir() / frames[7].image), fs::weakly_canonical(clip));
  FramePictures pictures(project.dir());
  EXPECT_EQ(pictures.Read(frames[7]).cols, frames[7].width_px);
}

TEST(LabelInputs, TheTimesOfAVideoThatIsReadForItLeadToAnyFrameAtOnce) {
  const fs::path folder = testing::ScratchDir() / "times";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string video = (folder / "even.avi").string();
  testing::WriteVideo(video, MovingTexture(160), 30.0);
  struct Stopped {};
  double before = 0.0;
  const auto stop_halfway = [&](double fraction) {
    EXPECT_GE(fraction, before);
    before = fraction;
    if (fraction >= 0.5) throw Stopped();
  };
  EXPECT_THROW(FindLabelsFile({video}, "", "body15", stop_halfway), Stopped);
  EXPECT_FALSE(fs::exists(folder / "even.labels.json"));
  VideoTimes times;
  const fs::path file = FindLabelsFile({video}, "", "body15", {}, &times);
  const LabelProject project(file);
  const auto& frames = project.labels().frames;
  ASSERT_EQ(times.at("even.avi").size(), frames.size());
  for (size_t f = 0; f < frames.size(); ++f) EXPECT_EQ(times["even.avi"][f], frames[f].time_s);
  FramePictures pictures(project.dir(), times);
  EXPECT_TRUE(AreSame(pictures.Read(frames[150]), AllFrames(video)[150]));
  EXPECT_EQ(pictures.num_seeks(), 1);
  times.clear();
  EXPECT_EQ(FindLabelsFile({video}, "", "body15", {}, &times), file);
  EXPECT_TRUE(times.empty());  // it may be another video by now
}

}  // namespace
}  // namespace poselift
