// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The program itself, run as a user would on files that are broken in every way
// we could think of. Every reading command refuses each in one line that names
// the file (and the line, where it is text), writes nothing, and ends. That the
// same command takes the unbroken file shows that it is the damage it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "src/io/image.h"
#include "src/io/text_scanner.h"
#include "tests/support/broken_input.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/mutation.h"
#include "tests/support/random_codebook.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::CanRunAsNobody;
using testing::ExpectRefusal;
using testing::ExpectRefusals;
using testing::FileText;
using testing::Replaced;
using testing::RunAs;
using testing::RunProgram;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

const std::string kBvh =
    "HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 3 Zrotation Xrotation Yrotation\n"
    " End Site\n {\n  OFFSET 0 10 0\n }\n}\nMOTION\nFrames: 2\nFrame Time: 0.01\n1 2 3\n4 5 6\n";

TEST(BrokenInput, BvhIsRefusedByInfoAndConvert) {
  ExpectRefusals(
      "a.bvh", kBvh, {"info {}", "convert {} out.bvh", "convert {} out.amc"},
      {{"truncated in the tree", kBvh.substr(0, 40), ":5"},
       {"truncated in a frame", kBvh.substr(0, kBvh.size() - 3), ":15"},
       {"NaN", Replaced(kBvh, "4 5 6", "4 nan 6"), ":15"},
       {"1e999", Replaced(kBvh, "0 10 0", "0 1e999 0"), ":8"},
       {"too few frames", Replaced(kBvh, "Frames: 2", "Frames: 3"), ""},
       {"huge number of frames", Replaced(kBvh, "Frames: 2", "Frames: 2000000000"), ""},
       {"huge number of channels", Replaced(kBvh, "CHANNELS 3", "CHANNELS 999999"), ":5"},
       {"wrong word", Replaced(kBvh, "OFFSET", "OFSET"), ":4"}});
}

// A skeleton and a motion that train takes: 01.asf and 01_01.amc.
struct MotionFiles {
  std::string asf;
  std::string amc;
};

MotionFiles WriteMotionFiles() {
  auto rng = TestRng();
  Motion motion = testing::RandomMotion(testing::CmuLikeSkeleton(), 40, &rng);
  motion.frame_time_s = kCmuFrameTime_s;
  WriteAsf(motion.skeleton, ScratchDir() / "01.asf");
  WriteAmc(motion, ScratchDir() / "01_01.amc");
  return {FileText(ScratchDir() / "01.asf"), FileText(ScratchDir() / "01_01.amc")};
}

const std::vector<std::string> kMotionCommands = {
    "info {}", "convert {} out.bvh",
    "train --mocap . --out out.pldict --json out.json --atoms 4 --sparsity 2 --subsets 1 "
    "--iterations 1"};

TEST(BrokenInput, AmcIsRefusedByInfoConvertAndTrain) {
  const std::string amc = WriteMotionFiles().amc;
  ExpectRefusals("01_01.amc", amc, kMotionCommands,
                 {{"truncated", amc.substr(0, amc.size() * 2 / 3), ":"},
                  {"header alone", amc.substr(0, amc.find("\n1\n") + 1), ":"},
                  {"NaN", Replaced(amc, "\nroot ", "\nroot nan "), ":"},
                  {"1e999", Replaced(amc, "\nroot ", "\nroot 1e999 "), ":"},
                  {"wrong count of values", Replaced(amc, "\nroot ", "\nroot 1 "), ":"},
                  {"huge frame number", Replaced(amc, "\n2\n", "\n99999999999999999999\n"), ":"},
                  {"unknown bone", Replaced(amc, "\nltibia ", "\ntail "), ":"}});
}

TEST(BrokenInput, AsfIsRefusedByInfoConvertAndTrain) {
  const std::string asf = WriteMotionFiles().asf;
  const std::vector<std::string> commands = {"info {}", "convert {} out.bvh", "info 01_01.amc",
                                             "convert 01_01.amc out.bvh --skeleton {}",
                                             kMotionCommands.back()};
  ExpectRefusals("01.asf", asf, commands,
                 {{"truncated", asf.substr(0, asf.size() / 2), ""},
                  {"NaN", Replaced(asf, "direction ", "direction nan "), ":"},
                  {"1e999", Replaced(asf, "direction ", "direction 1e999 "), ":"},
                  {"unit of zero", Replaced(asf, "length ", "length -"), ":"},
                  {"unknown bone", Replaced(asf, "name ltibia", "name tail"), ":"}});
}

TEST(BrokenInput, LabelsAreRefusedByInfo) {
  const std::string labels = FileText(testing::SourcePath("tests/golden/labels.json"));
  ExpectRefusals(
      "labels.json", labels, {"info {}"},
      {{"truncated", labels.substr(0, labels.size() / 2), ":4"},
       {"newer version", Replaced(labels, "\"version\": 1", "\"version\": 2"), ":1"},
       {"another format", Replaced(labels, "poselift-labels", "else"), ":1"},
       {"unknown layout", Replaced(labels, "body15", "body16"), ":1"},
       {"unknown joint", Replaced(labels, "left_knee", "left_kneee"), ":4"},
       {"NaN", Replaced(labels, "429.25", "NaN"), ":4"},
       {"1e999", Replaced(labels, "429.25", "1e999"), ":4"},
       {"huge coordinate", Replaced(labels, "429.25", "1e300"), ":4"},
       {"huge picture", Replaced(labels, "640", "1e12"), ":3"},
       {"negative radius", Replaced(labels, "\"radius_px\": 2", "\"radius_px\": -2"), ":4"},
       {"JSON of another kind", "{\"a\": 1}",
        ":1: found JSON without labels (an object with \"a\")"},
       {"a list of numbers", "[1, 2]", ":1"},
       {"OpenPose with a wrong count", "{\"people\": [{\"pose_keypoints_2d\": [1, 2]}]}", ":1"},
       {"COCO with a wrong count", "[{\"image_id\": 1, \"keypoints\": [1, 2]}]", ":1"}});
}

TEST(BrokenInput, PosesAreRefusedByInfo) {
  const std::string poses = FileText(testing::SourcePath("tests/golden/poses.json"));
  ExpectRefusals("poses.json", poses, {"info {}"},
                 {{"truncated", poses.substr(0, poses.size() / 2), ":"},
                  {"newer version", Replaced(poses, "\"version\": 1", "\"version\": 2"), ":1"},
                  {"NaN", Replaced(poses, "-0.5", "NaN"), ":5"},
                  {"1e999", Replaced(poses, "-0.5", "1e999"), ":5"},
                  {"wrong count", Replaced(poses, "-0.5,", ""), ":5"}});
}

const std::string kCamera =
    "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n"
    "  rows: 3\n  cols: 3\n  dt: d\n  data: [600, 0, 320, 0, 600, 240, 0, 0, 1]\n"
    "distortion_coefficients: !!opencv-matrix\n  rows: 1\n  cols: 4\n  dt: d\n"
    "  data: [0.01, 0, 0, 0]\n";

TEST(BrokenInput, CamerasAreRefusedByInfo) {
  ExpectRefusals("camera.yaml", kCamera, {"info {}"},
                 {{"truncated", kCamera.substr(0, 130), ""},
                  {"NaN", Replaced(kCamera, "600", ".nan"), ":9"},
                  {"1e999", Replaced(kCamera, "600", "1e999"), ":9"},
                  {"wrong count", Replaced(kCamera, "600, ", ""), ":9"},
                  {"huge picture", Replaced(kCamera, "640", "99999999999"), ":3"},
                  {"no focal length", Replaced(kCamera, "600", "0"), ""}});
}

TEST(BrokenInput, DictionariesAreRefusedByInfo) {
  auto rng = TestRng();
  const fs::path path = ScratchDir() / "d.pldict";
  WriteDictionary(testing::RandomDictionary(5, &rng), path);
  const std::string whole = FileText(path);
  std::string altered = whole, newer = whole, huge = whole;
  altered[whole.size() / 2] ^= 1;
  newer[8] = 2;                                       // the version
  for (size_t i = 12; i < 20; ++i) huge[i] = '\x7F';  // the header's size
  ExpectRefusals("d.pldict", whole, {"info {}"},
                 {{"truncated", whole.substr(0, whole.size() / 2), ": is cut short"},
                  {"altered", altered, ": is altered"},
                  {"newer version", newer, ": has format version 2"},
                  {"huge size", huge, ""},
                  {"longer", whole + "x", ": is altered"}});
}

TEST(BrokenInput, MotionCodebooksAreRefusedByInfo) {
  const fs::path path = ScratchDir() / "m.plmotion";
  WriteMotionCodebook(testing::RandomCodebook(3), path);
  const std::string whole = FileText(path);
  std::string altered = whole, newer = whole;
  altered[whole.size() / 2] ^= 1;
  newer[8] = 3;  // the version
  ExpectRefusals(
      "m.plmotion", whole, {"info {}"},
      {{"truncated", whole.substr(0, whole.size() / 2), ": is cut short"},
       {"altered", altered, ": is altered"},
       {"newer version", newer, ": has format version 3"},
       {"a dictionary's", Replaced(whole, "PLMOTN", "PLDICT"), ": has format version 2"}});
}

TEST(BrokenInput, PicturesAreRefusedByInfo) {
  WritePng(ScratchDir() / "p.png", cv::Mat(40, 60, CV_8UC3, cv::Scalar(1, 2, 3)));
  const std::string png = FileText(ScratchDir() / "p.png");
  ExpectRefusals("p.png", png, {"info {}"},
                 {{"text", "no picture\n", ": is no picture"},
                  {"head alone", png.substr(0, 33), ""},
                  {"huge size", Replaced(png, {"\0\0\0\x3C", 4}, "\x7F\xFF\xFF\xFF"), ""}});
}

TEST(BrokenInput, WithoutPermissionFilesAndFoldersAreRefused) {
  if (!CanRunAsNobody())
    GTEST_SKIP() << "only root can run the program as a user without permission";
  WriteMotionFiles();
  WriteScratch("locked.bvh", kBvh);
  fs::permissions(ScratchDir() / "locked.bvh", fs::perms::none);
  fs::create_directory(ScratchDir() / "locked");
  WriteScratch("locked/01_01.amc", "");
  fs::permissions(ScratchDir() / "locked", fs::perms::none);
  for (const char* arguments :
       {"info locked.bvh", "convert locked.bvh out.bvh", "info locked/01_01.amc", "info locked",
        "convert locked/01_01.amc out.bvh", "convert 01_01.amc out.bvh --skeleton locked/01.asf",
        "train --mocap locked --out out.pldict", "train --mocap . --out out.pldict"})
    ExpectRefusal(arguments, "locked", RunAs::kNobody);
  fs::permissions(ScratchDir() / "locked", fs::perms::owner_all);
}

TEST(BrokenInput, FoldersWithoutWhatIsWantedAreRefused) {
  fs::create_directory(ScratchDir() / "nothing");
  ExpectRefusal("train --mocap nothing --out out.pldict", "nothing");
  ExpectRefusal("train --mocap absent --out out.pldict", "absent");
  ExpectRefusal("info nothing", "nothing: found no file *_keypoints.json");
  WriteScratch("nothing/01_01.amc", "1\nroot 0 0 0 0 0 0\n");
  ExpectRefusal("train --mocap nothing --out out.pldict", "nothing");  // no ASF
}

// Their frames cannot stand in one table.
TEST(BrokenInput, TrainRefusesSkeletonsThatDoNotFit) {
  const std::string asf = WriteMotionFiles().asf;
  const std::string& train = kMotionCommands.back();
  WriteScratch("02.asf", std::string(testing::kMadeUpAsf));
  WriteScratch("02_01.amc", "1\nroot 0 0 0 0 0 0\nltibia 1\n");
  ExpectRefusal(train, "02.asf: made_up: found no bone");

  Skeleton stiff = testing::CmuLikeSkeleton();
  stiff.bones[*stiff.FindBone("ltibia")].dofs.clear();
  WriteAsf(stiff, ScratchDir() / "02.asf");
  WriteAmc({stiff, kCmuFrameTime_s, {SkeletonPose::Rest(stiff)}}, ScratchDir() / "02_01.amc");
  ExpectRefusal(train, "02.asf: found other degrees of freedom at the bone ltibia than in");
  fs::remove(ScratchDir() / "01_01.amc");
  ExpectRefusal(train, "02.asf: found other degrees of freedom at the bone ltibia than at rtibia");
}

TEST(BrokenInput, WrongUsageIsToldFromBrokenFiles) {
  WriteScratch("a.bvh", kBvh);
  for (const char* arguments :
       {"", "dance", "info", "info --colour a.bvh", "convert a.bvh",
        "convert a.bvh out.bvh --units miles", "convert a.bvh out.bvh --fps nan", "train",
        "train --mocap . --out out.pldict --atoms many",
        "train --mocap . --out out.pldict --segments 5",
        "train --mocap . --out out.plmotion --motion --segments 0",
        "train --mocap . --out out.plmotion --motion --atoms 5",
        "train --mocap . --out out.pldict --stride 0"}) {
    const auto run = RunProgram(arguments);
    EXPECT_EQ(run.code, 2) << arguments << "\n" << run.err;
    EXPECT_NE(run.err, "") << arguments;
    EXPECT_EQ(run.out, "") << arguments;
  }
}

}  // namespace
}  // namespace poselift
