// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// `poselift track` and `tags fit`, run as a user would, on pictures of a made-up person in
// tags that are rendered here, with the models that ship. Checked: files and lines against
// the truth, and what is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "calib/tag_family.h"
#include "lift/dictionary_file.h"
#include "src/forward_kinematics.h"
#include "src/io/body_tags_toml.h"
#include "src/io/camera_yaml.h"
#include "src/io/image.h"
#include "src/io/motion_file.h"
#include "src/io/poses_json.h"
#include "src/level_camera.h"
#include "src/testing/body_renderer.h"
#include "tests/support/broken_input.h"
#include "tests/support/mutation.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"
#include "tests/support/tagged_person.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::FileText;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ProgramRun;
using testing::Replaced;
using testing::RunProgram;
using testing::ScratchDir;
using testing::WriteScratch;

constexpr double kRate_hz = 15.0;
const std::string kModels = " --dictionary " + testing::SourcePath("data/default.pldict").string() +
                            " --motion-model " +
                            testing::SourcePath("data/default.plmotion").string();

class TrackProgram : public ::testing::Test {
 protected:
  TrackProgram() : person_(ReadDictionary(testing::SourcePath("data/default.pldict")).skeleton) {
    WriteBodyTags(person_.worn, ScratchDir() / "tags.toml");
    WriteCameraYaml(person_.camera, ScratchDir() / "camera.yaml");
  }

  void Render(int num_frames, const Eigen::Quaterniond& cam_from_world = kLevelFromCam) const {
    const TagFamily family(person_.worn.family);
    const testing::BodyRenderer renderer(
        person_.skeleton, person_.worn,
        [&](int id) {
          return testing::TagPrint{family.Image(id), family.cells_of_size()};
        },
        person_.camera, Eigen::Isometry3d(cam_from_world), {.noise_grey_levels = 2.0});
    fs::create_directories(ScratchDir() / "frames");
    for (int f = 0; f < num_frames; ++f) {
      const auto frame = renderer.Render([&](double t) { return person_.PoseAt(t); }, f / kRate_hz);
      WritePng(ScratchDir() / "frames" / fmt::format("f{}.png", f), frame.picture);
    }
  }

  double Error_mm(const FramePoses& frame) const {
    const SkeletonPose truth = person_.PoseAt(*frame.time_s);
    Pose3 joints = kLevelFromCam.toRotationMatrix() * JointPositions(person_.skeleton, truth);
    joints.colwise() -= joints.col(joint::kPelvis).eval();
    return 1e3 * (frame.people.front().joints_in_cam_m - joints).colwise().norm().mean();
  }

  testing::TaggedPerson person_;
};

TEST_F(TrackProgram, FollowsAFolderOfPicturesIntoFilesAndLines) {
  constexpr int kFrames = 12;
  Render(kFrames);
  const ProgramRun run = RunProgram(
      "track frames --fps 15 --camera camera.yaml --tags tags.toml --out run --stream --json "
      "report.json" +
      kModels);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("12 frames"));
  EXPECT_THAT(run.err, HasSubstr("12 ok, 0 filled, 0 not known"));
  EXPECT_THAT(FileText(ScratchDir() / "report.json"), HasSubstr("\"ok\": 12"));

  const Poses poses = ReadPosesJson(ScratchDir() / "run/poses.json");
  ASSERT_EQ(poses.frames.size(), static_cast<size_t>(kFrames));
  for (const FramePoses& frame : poses.frames) EXPECT_LT(Error_mm(frame), 60.0);
  EXPECT_EQ(ReadMotion(ScratchDir() / "run/poses.bvh").frames.size(), static_cast<size_t>(kFrames));
  EXPECT_TRUE(fs::exists(ScratchDir() / "run/angles.csv"));
  EXPECT_TRUE(fs::exists(ScratchDir() / "run/angles_sigma.csv"));

  std::istringstream lines(run.out);
  std::string line;
  int count = 0;
  while (std::getline(lines, line)) {
    const FramePoses frame = ReadFramePosesLine(line, "stream", ++count);
    EXPECT_LT((frame.people.front().joints_in_cam_m -
               poses.frames[static_cast<size_t>(count - 1)].people.front().joints_in_cam_m)
                  .norm(),
              1e-5);
  }
  EXPECT_EQ(count, kFrames);
}

TEST_F(TrackProgram, WithoutACameraItTakesAFieldOfView) {
  Render(5);
  const ProgramRun run =
      RunProgram("track frames --fps 15 --fov-deg 70.8 --tags tags.toml --out run" + kModels);
  ASSERT_EQ(run.code, 0) << run.err;
  for (const FramePoses& frame : ReadPosesJson(ScratchDir() / "run/poses.json").frames)
    EXPECT_LT(Error_mm(frame), 80.0);
}

// Over the person, who is then upright all the same.
TEST_F(TrackProgram, ACameraMayLookDown) {
  constexpr double kPitch_deg = 15.0;
  Render(5, Eigen::AngleAxisd(kPitch_deg * EIGEN_PI / 180.0, Eigen::Vector3d::UnitX()) *
                kLevelFromCam);
  for (const double said_deg : {0.0, kPitch_deg}) {
    const ProgramRun run = RunProgram(
        fmt::format("track frames --fps 15 --camera camera.yaml --tags tags.toml --out run{0} "
                    "--pitch-deg {0}",
                    said_deg) +
        kModels);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err.find("taken for level") == std::string::npos, said_deg != 0.0) << run.err;
    const Motion motion = ReadMotion(ScratchDir() / fmt::format("run{}/poses.bvh", said_deg));
    for (size_t f = 0; f < motion.frames.size(); ++f) {
      const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
      const double off_deg =
          std::acos(
              (motion.frames[f].world_from_root * up)
                  .dot(person_.PoseAt(static_cast<double>(f) / kRate_hz).world_from_root * up)) *
          180.0 / EIGEN_PI;
      EXPECT_NEAR(off_deg, kPitch_deg - said_deg, 5.0);
    }
  }
}

TEST_F(TrackProgram, FitsTagsThatTrackThenReads) {
  Render(20);
  const ProgramRun fit = RunProgram(
      "tags fit frames --fps 15 --camera camera.yaml --tags tags.toml --out mine.toml "
      "--frames 15" +
      kModels);
  ASSERT_EQ(fit.code, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("adjusted together; tags in mine.toml"));
  const BodyTags found = ReadBodyTags(ScratchDir() / "mine.toml");
  EXPECT_EQ(found.tags.size(), person_.worn.tags.size());
  EXPECT_EQ(found.bone_lengths_m.size(), static_cast<size_t>(kNumJoints - 1));
  const ProgramRun run =
      RunProgram("track frames --fps 15 --camera camera.yaml --tags mine.toml --out run" + kModels);
  ASSERT_EQ(run.code, 0) << run.err;
  for (const FramePoses& frame : ReadPosesJson(ScratchDir() / "run/poses.json").frames)
    EXPECT_LT(Error_mm(frame), 60.0);
}

TEST_F(TrackProgram, AFitThatNoHumanCanHaveIsNotWritten) {
  Render(20);
  BodyTags large = person_.worn;
  for (BodyTag& tag : large.tags) tag.size_m *= 1.8;
  for (BodyTag& tag : large.tags) tag.on_bone->sigma_m = 0.03;
  WriteBodyTags(large, ScratchDir() / "large.toml");
  const std::string command =
      "tags fit frames --fps 15 --camera camera.yaml --tags large.toml --out mine.toml --frames "
      "15" +
      kModels;
  const ProgramRun refused = RunProgram(command);
  EXPECT_EQ(refused.code, 1) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("Is the tags' size right?"));
  EXPECT_FALSE(fs::exists(ScratchDir() / "mine.toml"));
  const ProgramRun forced = RunProgram(command + " --force");
  EXPECT_EQ(forced.code, 0) << forced.err;
  // Who tracks with it hears of it.
  const ProgramRun run =
      RunProgram("track frames --fps 15 --camera camera.yaml --tags mine.toml --out run" + kModels);
  EXPECT_THAT(run.err, HasSubstr("Is the tags' size right?"));
}

TEST_F(TrackProgram, ACamerasRecordingIsNotReplacedUnasked) {
  Render(3);
  const std::string command =
      "track frames --fps 15 --camera camera.yaml --tags tags.toml --out run" + kModels;
  ASSERT_EQ(RunProgram(command).code, 0);
  // Of files it can be had again.
  const ProgramRun again = RunProgram(command);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("replaces the recording in run"));
  const auto is_refused = [&] {
    const ProgramRun refused = RunProgram(command);
    EXPECT_THAT(refused.err, HasSubstr("--overwrite"));
    return refused.code == 3;
  };
  WriteScratch("run/video.mkv", "a camera's");
  EXPECT_TRUE(is_refused());
  fs::remove(ScratchDir() / "run" / "video.mkv");
  const std::string poses = FileText(ScratchDir() / "run" / "poses.json");
  WriteScratch("run/poses.json", Replaced(poses, "\"files\"", "\"camera\""));
  EXPECT_TRUE(is_refused());
  WriteScratch("run/poses.json", Replaced(poses, " \"source\": \"files\",\n", ""));  // of lift
  EXPECT_TRUE(is_refused());
  EXPECT_EQ(RunProgram(command + " --overwrite").code, 0);
}

// Real: the sample clip, whose last two fifths are zeros here.
TEST_F(TrackProgram, AVideoThatLacksFramesIsSaidToBeDamaged) {
  const std::string samples = testing::SourcePath("samples/tags/").string();
  std::string clip = FileText(samples + "clip.mp4");
  std::fill(clip.begin() + std::ssize(clip) * 3 / 5, clip.end(), '\0');
  WriteScratch("damaged.mp4", clip);
  const std::string rest =
      " --camera " + samples + "camera.yaml --tags " + samples + "tags.toml --out run" + kModels;
  const ProgramRun run = RunProgram("track damaged.mp4" + rest);
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.err, HasSubstr("frames where 90 are stated: it is damaged"));
  EXPECT_THAT(RunProgram("track " + samples + "clip.mp4 --seconds 1 --overwrite" + rest).err,
              Not(HasSubstr("stated")));
}

TEST_F(TrackProgram, FitsTheCameraToo) {
  Render(20);
  const ProgramRun fit = RunProgram(
      "tags fit frames --fps 15 --fov-deg 60 --tags tags.toml --out mine.toml --frames 20" +
      kModels);
  ASSERT_EQ(fit.code, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("track with --camera mine.camera.yaml"));
  const Camera found = ReadCameraYaml(ScratchDir() / "mine.camera.yaml");
  EXPECT_NEAR(found.fx_px / person_.camera.fx_px, 1.0, 0.08);  // 60 degrees: 1.23
  const ProgramRun run = RunProgram(
      "track frames --fps 15 --camera mine.camera.yaml --tags mine.toml --out run" + kModels);
  ASSERT_EQ(run.code, 0) << run.err;
  for (const FramePoses& frame : ReadPosesJson(ScratchDir() / "run/poses.json").frames)
    EXPECT_LT(Error_mm(frame), 60.0);
}

TEST_F(TrackProgram, WhatIsWrongIsRefusedBeforeAnythingIsWritten) {
  fs::create_directories(ScratchDir() / "frames");
  WritePng(ScratchDir() / "frames/a.png", cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(90)));
  const auto expect = [&](const std::string& arguments, int code, const std::string& text) {
    const ProgramRun run = RunProgram(arguments + kModels);
    EXPECT_EQ(run.code, code) << arguments << "\n" << run.err;
    EXPECT_THAT(run.err, HasSubstr(text)) << arguments;
    EXPECT_FALSE(fs::exists(ScratchDir() / "run")) << arguments;
  };
  expect("track frames --tags nothing.toml --out run", 3, "nothing.toml");
  expect("track nothing --tags tags.toml --out run", 3, "nothing");
  expect("track frames --tags tags.toml --camera camera.yaml --out run", 3,
         "a camera of 1280 x 720 pixels and pictures of 640 x 480");
  expect("track frames --tags tags.toml", 2, "--out, --stream or --udp");
  expect("track frames --tags tags.toml --out run --record", 3, "recorded already");
  expect("track frames --tags tags.toml --out run --record-before-s 2", 2, "--record");
  expect("track frames --tags tags.toml --out run --set gain=2", 2, "--set: says nothing here");
  expect("track frames --tags tags.toml --out run --realtime --size 640x480", 2, "--size");
  expect("trak frames --tags tags.toml --out run", 2, "wanted perhaps: poselift track");
  expect("tags fti frames", 2, "wanted perhaps: poselift tags fit");
  WriteScratch("broken.toml", "family = \"tag36h11\"\n[[tag]]\nid = 1\nsize_mm = \"x\"\n");
  expect("track frames --tags broken.toml --out run", 3, "broken.toml:4");
}

TEST_F(TrackProgram, ABrokenPictureEndsTheRecordingWithTheLastGoodFrame) {
  Render(6);
  WriteScratch("frames/f4.png", "no picture");
  const ProgramRun run = RunProgram(
      "track frames --fps 15 --tags tags.toml --camera camera.yaml --out run --latency-s 0.2 "
      "--json report.json" +
      kModels);
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_THAT(run.err, HasSubstr("f4.png"));
  EXPECT_EQ(ReadPosesJson(ScratchDir() / "run/poses.json").frames.size(), 4U);
  EXPECT_THAT(FileText(ScratchDir() / "report.json"), HasSubstr("\"frames\": 4"));
  // The motion has the pictures' rate.
  EXPECT_NEAR(ReadMotion(ScratchDir() / "run/poses.bvh").frame_time_s, 1.0 / 15.0, 1e-6);
}

TEST_F(TrackProgram, ARecordingGoesOnWhenTheStreamsReaderEnds) {
  Render(6);
  const std::string command = std::string("cd ") + ScratchDir().string() + " && " +
                              POSELIFT_PROGRAM + " track frames --tags tags.toml --camera " +
                              "camera.yaml --stream --out run" + kModels + " 2>log | true";
  ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT(concurrency-mt-unsafe): one thread
  EXPECT_EQ(ReadPosesJson(ScratchDir() / "run/poses.json").frames.size(), 6U);
  EXPECT_THAT(FileText(ScratchDir() / "log"), HasSubstr("The recording goes on"));
}

TEST_F(TrackProgram, NobodySeenIsAFailureThatTheFilesTell) {
  fs::create_directories(ScratchDir() / "frames");
  for (const char* name : {"frames/a.png", "frames/b.png"})
    WritePng(ScratchDir() / name, cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(90)));
  const ProgramRun run = RunProgram("track frames --tags tags.toml --out run" + kModels);
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.out, HasSubstr("0 ok, 0 filled, 2 not known"));
  EXPECT_EQ(ReadPosesJson(ScratchDir() / "run/poses.json").frames.at(1).people.front().status,
            "not known");
}

}  // namespace
}  // namespace poselift
