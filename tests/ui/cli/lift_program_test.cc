// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// `poselift lift`, run as a user would, with a made-up dictionary and labels.
// Files that are broken in every way we could think of are refused in one line
// before anything is written. Labels that are whole but say too little are no
// broken file: poses.json says of each person why there is no pose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "lift/dictionary_file.h"
#include "src/io/camera_yaml.h"
#include "src/io/image.h"
#include "src/io/poses_json.h"
#include "tests/support/broken_input.h"
#include "tests/support/mutation.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::ExpectRefusal;
using testing::ExpectRefusals;
using testing::FileText;
using ::testing::HasSubstr;
using testing::ProgramRun;
using testing::Replaced;
using testing::RunProgram;
using testing::ScratchDir;
using testing::SourcePath;
using testing::TestRng;
using testing::WriteScratch;

constexpr const char* kStanding =
    R"("left_hip": {"x": 330, "y": 250}, "left_knee": {"x": 335, "y": 330},
 "left_ankle": {"x": 337, "y": 410}, "right_hip": {"x": 300, "y": 250},
 "right_knee": {"x": 295, "y": 330}, "right_ankle": {"x": 293, "y": 410},
 "left_shoulder": {"x": 350, "y": 140}, "left_elbow": {"x": 375, "y": 190, "radius_px": 4},
 "left_wrist": {"x": 380, "y": 245}, "right_shoulder": {"x": 280, "y": 140},
 "right_elbow": {"x": 255, "y": 190}, "right_wrist": {"x": 250, "y": 245})";

std::string LabelsOf(const std::string& joints) {
  return R"({"format": "poselift-labels", "version": 1, "layout": "body15", "frames": [
{"image": "man.png", "width": 640, "height": 480, "people": [
{"id": 7, "joints": {)" +
         joints + "}}]}]}\n";
}

// What a lift reads: d.pldict, labels.json and man.png.
void WriteInputs() {
  auto rng = TestRng();
  Dictionary dictionary = testing::RandomDictionary(20, &rng);
  dictionary.prior = LearnPosePrior(testing::RandomDictionary(200, &rng).atoms);
  WriteDictionary(dictionary, ScratchDir() / "d.pldict");
  WriteScratch("labels.json", LabelsOf(kStanding));
  WritePng(ScratchDir() / "man.png", cv::Mat(480, 640, CV_8UC3, cv::Scalar(90, 90, 90)));
}

const std::string kLift = "lift man.png --labels labels.json --dictionary d.pldict --out out";

TEST(LiftProgram, RefusesBrokenLabels) {
  WriteInputs();
  const std::string labels = LabelsOf(kStanding);
  ExpectRefusals("labels.json", labels, {kLift, "lift --labels {} --dictionary d.pldict --out out"},
                 {{"truncated", labels.substr(0, labels.size() / 2), ":"},
                  {"newer version", Replaced(labels, "\"version\": 1", "\"version\": 2"), ":1"},
                  {"unknown joint", Replaced(labels, "left_hip", "left_hop"), ":3"},
                  {"unknown layout", Replaced(labels, "body15", "body16"), ":1"},
                  {"NaN", Replaced(labels, "330", "NaN"), ":3"},
                  {"1e999", Replaced(labels, "330", "1e999"), ":3"},
                  {"negative radius", Replaced(labels, "px\": 4", "px\": -4"), ":6"},
                  {"a joint without y", Replaced(labels, ", \"y\": 250", ""), ":3"},
                  {"huge picture", Replaced(labels, "640", "999999999999"), ":2"}});
}

TEST(LiftProgram, RefusesBrokenPicturesBeforeItWritesAnything) {
  WriteInputs();
  const std::string png = FileText(ScratchDir() / "man.png");
  const std::string command = "lift {} --labels labels.json --dictionary d.pldict --out out";
  ExpectRefusals("man.png", png, {command},
                 {{"text", "no picture\n", ": is no picture"},
                  {"head alone", png.substr(0, 33), ""},
                  {"truncated", png.substr(0, 50), ""}});
}

TEST(LiftProgram, RefusesBrokenDictionaries) {
  WriteInputs();
  const std::string whole = FileText(ScratchDir() / "d.pldict");
  std::string altered = whole;
  altered[whole.size() / 2] ^= 1;
  ExpectRefusals("d.pldict", whole, {kLift},
                 {{"truncated", whole.substr(0, whole.size() / 2), ": is cut short"},
                  {"altered", altered, ": is altered"}});
}

TEST(LiftProgram, RefusesBrokenCameras) {
  WriteInputs();
  const std::string camera =
      "image_width: 640\nimage_height: 480\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [600, 0, 320, 0, 600, 240, 0, 0, 1]\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 4\n  data: [0.01, 0, 0, 0]\n";
  ExpectRefusals("camera.yaml", camera, {kLift + " --camera {}"},
                 {{"truncated", camera.substr(0, 50), ""},
                  {"NaN", Replaced(camera, "600", "nan"), ":6"},
                  {"no focal length", Replaced(camera, "600", "0"), ""}});
}

TEST(LiftProgram, TakesACameraThatIsOnlyRoughlyKnown) {
  const auto lifted = [](const std::string& camera) {
    const std::string out = (ScratchDir() / "rough").string();
    const ProgramRun run = RunProgram("lift " + SourcePath("samples/photo/throw.jpg").string() +
                                      camera + " --out " + out);
    EXPECT_EQ(run.code, 0) << run.err;
    return ReadPosesJson(fs::path(out) / "poses.json").frames[0].people[0];
  };
  const PersonPose known =
      lifted(" --camera " + SourcePath("samples/photo/throw.camera.yaml").string());
  const PersonPose focal = lifted(" --focal-px 1150");
  const PersonPose fov = lifted(" --fov-deg 38.3552");  // 2 atan(400 / 1150)
  EXPECT_GT(known.pelvis_in_cam_m.z(), 1.0);
  for (const PersonPose& rough : {focal, fov}) {
    EXPECT_TRUE(testing::MatrixNear(rough.pelvis_in_cam_m, known.pelvis_in_cam_m, 1e-3));
    EXPECT_TRUE(testing::MatrixNear(rough.joints_in_cam_m, known.joints_in_cam_m, 1e-3));
  }
  EXPECT_TRUE(lifted("").pelvis_in_cam_m.hasNaN());
}

TEST(LiftProgram, ACameraIsOfThePictures) {
  WriteInputs();
  const auto camera = [](int width_px, int height_px, double focal_px) {
    WriteCameraYaml(UncalibratedCamera(width_px, height_px, focal_px), ScratchDir() / "c.yaml");
    return kLift + " --camera c.yaml";
  };
  ExpectRefusal(camera(640, 360, 600), "c.yaml: found a camera of 640 x 360");
  const auto pelvis_m = [](const std::string& command) -> Eigen::Vector3d {
    EXPECT_EQ(RunProgram(command).code, 0);
    return ReadPosesJson(ScratchDir() / "out" / "poses.json").frames[0].people[0].pelvis_in_cam_m;
  };
  const Eigen::Vector3d same_m = pelvis_m(camera(640, 480, 600));
  EXPECT_TRUE(testing::MatrixNear(pelvis_m(camera(1280, 960, 1200)), same_m, 1e-6));
  ExpectRefusal(kLift + " --exif", "man.png: found no focal length in its EXIF");
  EXPECT_EQ(RunProgram(kLift + " --fov-deg 40 --focal-px 500").code, 2);
}

TEST(LiftProgram, RefusesBrokenTruthBeforeItWritesAnything) {
  WriteInputs();
  const std::string truth =
      R"({"units": "m", "joints_in_cam": {"left_hip": [0.1, 0, 0], "right_hip": [-0.1, 0, 0],
"left_knee": [0.1, 0.4, 0.1], "right_knee": [-0.1, 0.4, 0.2], "left_ankle": [0.1, 0.8, 0]}})";
  ExpectRefusals("truth.json", truth, {kLift + " --truth {}"},
                 {{"truncated", truth.substr(0, 90), ":"},
                  {"NaN", Replaced(truth, "0.4", "NaN"), ":2"},
                  {"wrong count", Replaced(truth, "0.4, ", ""), ":2"},
                  {"too few joints", R"({"units": "m", "joints_in_cam": {}})", ":1"}});
}

TEST(LiftProgram, RefusesWhatDoesNotFitTogether) {
  WriteInputs();
  ExpectRefusal(kLift + " --layout body16", "body16");
  ExpectRefusal("lift man.png --dictionary d.pldict --out out", "man.png: found no labels");
  fs::create_directory(ScratchDir() / "nothing");
  ExpectRefusal("lift nothing --labels labels.json --dictionary d.pldict --out out", "nothing");
  WriteScratch("no_folder", "");
  ExpectRefusal("lift man.png --labels labels.json --dictionary d.pldict --out no_folder",
                "no_folder");
}

TEST(LiftProgram, RefusesWhatItMayNotRead) {
  if (!testing::CanRunAsNobody())
    GTEST_SKIP() << "only root can run the program as a user without permission";
  WriteInputs();
  fs::create_directory(ScratchDir() / "locked");
  for (const char* file : {"man.png", "labels.json", "d.pldict"})
    fs::copy(ScratchDir() / file, ScratchDir() / "locked");
  fs::permissions(ScratchDir() / "locked", fs::perms::none);
  for (const std::string& command :
       {Replaced(kLift, "man.png", "locked/man.png"), Replaced(kLift, "man.png", "locked"),
        Replaced(kLift, "labels.json", "locked/labels.json"),
        Replaced(kLift, "d.pldict", "locked/d.pldict"), kLift + " --camera locked/camera.yaml",
        kLift + " --truth locked/truth.json", Replaced(kLift, "--out out", "--out locked/out")})
    ExpectRefusal(command, "locked", testing::RunAs::kNobody);
  fs::permissions(ScratchDir() / "locked", fs::perms::owner_all);
}

TEST(LiftProgram, TellsWrongUsage) {
  WriteInputs();
  for (const std::string& arguments :
       {std::string("lift"), kLift + " --method magic", kLift + " --fps 0", kLift + " --fps nan",
        kLift + " --seed many"})
    EXPECT_EQ(RunProgram(arguments).code, 2) << arguments;
  EXPECT_FALSE(fs::exists(ScratchDir() / "out"));
}

TEST(LiftProgram, SaysWhyNobodyCouldBeLifted) {
  const std::pair<const char*, std::string> cases[] = {
      {"no joint", ""},
      {"two joints", R"("left_hip": {"x": 330, "y": 250}, "left_knee": {"x": 335, "y": 330})"},
      {"all absent", R"("left_hip": {"state": "absent"}, "left_knee": {"state": "absent"})"},
      {"all at one point",
       R"("left_hip": {"x": 5, "y": 5}, "left_knee": {"x": 5, "y": 5}, "left_ankle": {"x": 5, "y": 5},
"right_hip": {"x": 5, "y": 5}, "right_knee": {"x": 5, "y": 5}, "right_ankle": {"x": 5, "y": 5})"}};
  for (const auto& [what, joints] : cases) {
    SCOPED_TRACE(what);
    WriteInputs();
    WriteScratch("labels.json", LabelsOf(joints));
    const ProgramRun run = RunProgram(kLift);
    EXPECT_EQ(run.code, 1) << run.err;
    EXPECT_THAT(run.out, HasSubstr("lifted 0 of 1 people"));
    const Poses poses = ReadPosesJson(ScratchDir() / "out/poses.json");
    ASSERT_EQ(poses.frames.size(), 1u);
    ASSERT_EQ(poses.frames[0].people.size(), 1u);
    EXPECT_EQ(poses.frames[0].people[0].id, 7);
    EXPECT_NE(poses.frames[0].people[0].status, "ok");
    EXPECT_NE(poses.frames[0].people[0].message, "");
  }
}

TEST(LiftProgram, LiftsTheOthersWhenOneCannotBeLifted) {
  WriteInputs();
  WriteScratch("labels.json", Replaced(LabelsOf(kStanding), "\"people\": [",
                                       "\"people\": [{\"id\": 3, \"joints\": {}},\n"));
  const ProgramRun run = RunProgram(kLift);
  EXPECT_EQ(run.code, 0) << run.err;
  const Poses poses = ReadPosesJson(ScratchDir() / "out/poses.json");
  ASSERT_EQ(poses.frames[0].people.size(), 2u);
  EXPECT_NE(poses.frames[0].people[0].status, "ok");
  EXPECT_EQ(poses.frames[0].people[1].status, "ok");
  EXPECT_TRUE(poses.frames[0].people[1].joints_in_cam_m.allFinite());
}

TEST(LiftProgram, SaysHowTallAHintMakesThemAndWhichHintsAreNotMet) {
  WriteInputs();
  WriteScratch("labels.json", Replaced(LabelsOf(kStanding), "\"joints\": {", R"("hints": [
{"kind": "height", "metres": 1.5},
{"kind": "nearer", "joint": "left_wrist", "than": "right_wrist", "metres": 1},
{"kind": "nearer", "joint": "right_wrist", "than": "left_wrist", "metres": 1}], "joints": {)"));
  const ProgramRun run = RunProgram(kLift);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("person 7, 1.50 m tall, bones at the standard stature: hip +0.0"));
  const Poses poses = ReadPosesJson(ScratchDir() / "out/poses.json");
  EXPECT_THAT(poses.frames[0].people[0].message, HasSubstr("wrist nearer than"));
  ASSERT_EQ(poses.bodies.size(), 1u);
  EXPECT_EQ(poses.bodies[0].id, 7);
}

}  // namespace
}  // namespace poselift
