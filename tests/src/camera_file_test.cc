// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the readers and writers. Checked: cameras of Kalibr and anipose as those programs write
// them, by name and flawed; what is written for ROS; formats told apart by content.
#include "src/io/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/input_error.h"
#include "src/io/camera_yaml.h"
#include "src/io/text_scanner.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::ScratchDir;
using testing::WriteScratch;

constexpr const char* kKalibr = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.8e-05]
  distortion_model: radtan
  intrinsics: [458.6, 457.3, 367.2, 248.4]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [0.99, 0.0, 0.0, -0.11]
  - [0.0, 0.99, 0.0, 0.0]
  - [0.0, 0.0, 0.99, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [-0.04, 0.01, 0.002, 0.003]
  distortion_model: equidistant
  intrinsics: [457.5, 456.1, 379.9, 255.2]
  resolution: [752, 480]
)";

constexpr const char* kAnipose = R"([cam_1]
name = "B"
size = [ 1280, 720,]
matrix = [ [ 900.5, 0.0, 639.5,], [ 0.0, 901.0, 359.5,], [ 0.0, 0.0, 1.0,],]
distortions = [ -0.1, 0.02, 0.001, -0.002, 0.003,]
rotation = [ 0.1, 0.2, 0.3,]
translation = [ 1.0, 2.0, 3.0,]

[cam_0]
name = "A"
size = [ 640, 480,]
matrix = [ [ 600.0, 0.0, 320.0,], [ 0.0, 600.0, 240.0,], [ 0.0, 0.0, 1.0,],]
distortions = [ 0.0, 0.0, 0.0, 0.0, 0.0,]
fisheye = true

[metadata]
adjusted = false
)";

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

std::string Complaint(const std::string& file, const std::string& text,
                      const std::string& name = "") {
  try {
    ReadCamera(WriteScratch(file, text), name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(read without complaint)";
}

TEST(CameraFile, KalibrsCamerasAreReadByName) {
  const auto path = WriteScratch("camchain.yaml", kKalibr);
  EXPECT_EQ(FormatOfCameraFile(path), CameraFileFormat::kKalibr);
  EXPECT_THAT(CameraNames(path), ElementsAre("cam0", "cam1"));
  const Camera camera = ReadCamera(path, "cam0");
  EXPECT_EQ(camera.width_px, 752);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.fx_px, 458.6);
  EXPECT_EQ(camera.cy_px, 248.4);
  EXPECT_EQ(camera.distortion.k2, 0.07);
  EXPECT_EQ(camera.distortion.p2, 1.8e-05);
  EXPECT_EQ(camera.distortion.k3, 0.0);
  EXPECT_THAT(Complaint("camchain.yaml", kKalibr, "cam1"),
              HasSubstr("camchain.yaml:17: cam1.distortion_model: found \"equidistant\", wanted "
                        "radtan"));
  EXPECT_THAT(Complaint("camchain.yaml", kKalibr, "cam2"),
              HasSubstr("found no camera \"cam2\", wanted one of cam0, cam1"));
}

TEST(CameraFile, AniposesCamerasAreInTheOrderOfTheFile) {
  const auto path = WriteScratch("calibration.toml", kAnipose);
  EXPECT_EQ(FormatOfCameraFile(path), CameraFileFormat::kAnipose);
  EXPECT_THAT(CameraNames(path), ElementsAre("B", "A"));
  const Camera camera = ReadCamera(path + "#B");
  EXPECT_EQ(camera.width_px, 1280);
  EXPECT_EQ(camera.fx_px, 900.5);
  EXPECT_EQ(camera.fy_px, 901.0);
  EXPECT_EQ(camera.cx_px, 639.5);
  EXPECT_EQ(camera.distortion.k3, 0.003);
  EXPECT_THAT(Complaint("calibration.toml", kAnipose, "A"),
              HasSubstr("calibration.toml:14: A.fisheye: found a fisheye lens"));
}

TEST(CameraFile, OfSeveralCamerasOneMustBeNamed) {
  EXPECT_THAT(Complaint("camchain.yaml", kKalibr),
              AllOf(HasSubstr("found the cameras cam0, cam1, wanted one"),
                    HasSubstr("camchain.yaml#cam0")));
  const std::string path = WriteScratch("camchain.yaml", kKalibr);
  EXPECT_EQ(ReadCamera(path + "#cam0").fx_px, 458.6);
  EXPECT_THROW(ReadCamera(path + "#cam7"), InputError);
  EXPECT_EQ(ReadCamera(WriteScratch("a#b.txt", kKalibr), "cam0").fx_px, 458.6);
}

TEST(CameraFile, TheNameOfTheFileDoesNotMatter) {
  EXPECT_EQ(ReadCamera(WriteScratch("a.txt", kKalibr), "cam0").fx_px, 458.6);
  EXPECT_EQ(ReadCamera(WriteScratch("b.yaml", kAnipose), "B").fx_px, 900.5);
}

TEST(CameraFile, RosAndOpenCvFilesAreWrittenAndRead) {
  Camera camera{1280, 720, 900.125, 899.0 + 1.0 / 3.0, 640.5, 360.25, {}};
  camera.distortion = {.k1 = 0.1, .k2 = -0.2, .p1 = 1e-3, .p2 = -2e-3, .k3 = 0.01};
  WriteCameraInfoYaml(camera, "my webcam", ScratchDir() / "info.yaml");
  WriteCameraYaml(camera, ScratchDir() / "opencv.yaml");
  for (const char* file : {"info.yaml", "opencv.yaml"}) {
    EXPECT_EQ(FormatOfCameraFile(ScratchDir() / file), CameraFileFormat::kOpenCvOrRos);
    const Camera read = ReadCamera(ScratchDir() / file);
    EXPECT_EQ(read.width_px, 1280);
    EXPECT_EQ(read.fy_px, camera.fy_px);
    EXPECT_EQ(read.cx_px, camera.cx_px);
    EXPECT_EQ(read.distortion.p2, -2e-3);
    EXPECT_EQ(read.distortion.k3, 0.01);
  }
  const std::string info = ReadTextFile(ScratchDir() / "info.yaml");
  EXPECT_THAT(info, HasSubstr("camera_name: my_webcam\n"));
  EXPECT_THAT(info, HasSubstr("distortion_model: plumb_bob\n"));
  EXPECT_THAT(info, HasSubstr("projection_matrix:\n  rows: 3\n  cols: 4\n  data: [900.125, 0,"));
}

struct Flaw {
  const char* name;
  const char* file;
  const char* good;
  const char* from;
  const char* to;
  const char* message;
};

class FlawedCameraFile : public ::testing::TestWithParam<Flaw> {};

TEST_P(FlawedCameraFile, IsRefusedWithPlaceAndReason) {
  const Flaw& flaw = GetParam();
  EXPECT_THAT(Complaint(flaw.file, Replaced(flaw.good, flaw.from, flaw.to)),
              AllOf(HasSubstr(flaw.file), HasSubstr(flaw.message)));
}

INSTANTIATE_TEST_SUITE_P(
    All, FlawedCameraFile,
    ::testing::Values(
        Flaw{"Omni", "k.yaml", kKalibr, "pinhole", "omni",
             "k.yaml:3: cam0.camera_model: found \"omni\", wanted pinhole"},
        Flaw{"ThreeIntrinsics", "k.yaml", kKalibr, ", 248.4", "",
             "k.yaml:6: cam0.intrinsics: found 3 numbers, wanted 4"},
        Flaw{"NoResolution", "k.yaml", kKalibr, "resolution", "size",
             "k.yaml:2: cam0: found no resolution"},
        Flaw{"NoNumber", "k.yaml", kKalibr, "457.3", "nan",
             "k.yaml:6: cam0.intrinsics[1]: found \"nan\", wanted a number"},
        Flaw{"HalfAPixel", "k.yaml", kKalibr, "752", "752.5", "wanted a whole number"},
        Flaw{"Negative", "k.yaml", kKalibr, "458.6", "-458.6", "found the focal length -458.6 px"},
        Flaw{"NotYaml", "k.yaml", kKalibr, "[752, 480]", "[752, 480", "found no YAML"},
        Flaw{"Twice", "k.yaml", kKalibr, "rostopic", "intrinsics", "found it twice"},
        Flaw{"Deep", "k.yaml", kKalibr, "[1]",
             "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
             "k.yaml:2: found more than 64 levels"},
        Flaw{"NoMatrix", "a.toml", kAnipose, "matrix = [ [ 900.5", "m = [ [ 900.5", "fisheye lens"},
        Flaw{"Skew", "a.toml", kAnipose, "900.5, 0.0", "900.5, 0.5", "a.toml:4: B.matrix: wanted"},
        Flaw{"SixCoefficients", "a.toml", kAnipose, "0.003,]", "0.003, 1.0,]",
             "a.toml:5: B.distortions: found 6 numbers"},
        Flaw{"Text", "a.toml", kAnipose, "-0.1", "\"x\"", "wanted a list of plain numbers"},
        Flaw{"Infinite", "a.toml", kAnipose, "-0.1", "inf", "wanted a list of plain numbers"},
        Flaw{"NotToml", "a.toml", kAnipose, "size = [", "size = ", "a.toml:3: found no TOML"},
        Flaw{"NoSize", "a.toml", kAnipose, "size", "extent", "a.toml:1: B: found no size"}),
    [](const auto& param_info) { return param_info.param.name; });

}  // namespace
}  // namespace poselift
