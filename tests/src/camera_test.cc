// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The lens model against numbers worked out by hand and against its own
// inverse; camera files as OpenCV and ROS write them, good and flawed.
#include "src/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <stdexcept>

#include "src/input_error.h"
#include "src/io/camera_yaml.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::MatrixNear;
using testing::WriteScratch;

constexpr const char* kOpenCv = R"(%YAML:1.0
---
calibration_time: "Sun 01 Nov 2020 12:00:00"
image_width: 640
image_height: 480
flags: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 6.5e+02, 0., 3.2025e+02, 0.,
       651., 2.4e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.5e-01, 1.0e-01, 1.0e-03, -2.0e-03, 5.0e-03 ]
extrinsic_parameters: !!opencv-matrix
   rows: 1
   cols: 3
   dt: d
   data: [ 1., 2., 3. ]
)";

constexpr const char* kRos = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [650, 0, 320.25, 0, 651, 240, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data:
  - -0.25
  - 0.1
  - 0.001
  - -0.002
  - 0.005
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
)";

Camera MadeUpCamera() {
  Camera camera{640, 480, 650, 651, 320.25, 240, {}};
  camera.distortion = {.k1 = -0.25, .k2 = 0.1, .p1 = 0.001, .p2 = -0.002, .k3 = 0.005};
  return camera;
}

void ExpectSame(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  EXPECT_EQ(a.fx_px, b.fx_px);
  EXPECT_EQ(a.fy_px, b.fy_px);
  EXPECT_EQ(a.cx_px, b.cx_px);
  EXPECT_EQ(a.cy_px, b.cy_px);
  EXPECT_EQ(a.distortion.k1, b.distortion.k1);
  EXPECT_EQ(a.distortion.k2, b.distortion.k2);
  EXPECT_EQ(a.distortion.p1, b.distortion.p1);
  EXPECT_EQ(a.distortion.p2, b.distortion.p2);
  EXPECT_EQ(a.distortion.k3, b.distortion.k3);
  EXPECT_EQ(a.distortion.k4, b.distortion.k4);
  EXPECT_EQ(a.distortion.k5, b.distortion.k5);
  EXPECT_EQ(a.distortion.k6, b.distortion.k6);
}

Camera Read(const std::string& text) { return ReadCameraYaml(WriteScratch("camera.yaml", text)); }

std::string Complaint(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(read without complaint)";
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

TEST(Camera, ProjectsByThePinholeEquation) {
  const Camera camera{640, 480, 500, 400, 320, 240, {}};
  EXPECT_TRUE(MatrixNear(camera.Project({1, -2, 4}), Eigen::Vector2d(445, 40), 1e-12));
}

TEST(Camera, DistortsByTheEquationsOfTheHeader) {
  Camera camera{100, 100, 1, 1, 0, 0, {}};
  camera.distortion = {.k1 = 0.1, .k2 = 0.2, .p1 = 0.01, .p2 = 0.02, .k3 = 0.3, .k4 = 0.04};
  // x = 0.5, y = 0.25: r2 = 0.3125.
  const double g = (1 + 0.1 * 0.3125 + 0.2 * 0.09765625 + 0.3 * 0.030517578125) / (1 + 0.0125);
  const Eigen::Vector2d expected(0.5 * g + 2 * 0.01 * 0.125 + 0.02 * (0.3125 + 0.5),
                                 0.25 * g + 0.01 * (0.3125 + 0.125) + 2 * 0.02 * 0.125);
  EXPECT_TRUE(MatrixNear(camera.Project({1, 0.5, 2}), expected, 1e-14));
}

TEST(Camera, UndistortIsTheInverseOfProject) {
  Camera barrel = MadeUpCamera();
  barrel.distortion.k4 = 0.05;
  Camera pincushion = MadeUpCamera();
  pincushion.distortion = {.k1 = 0.3, .k2 = 0.2};
  for (const Camera& camera : {barrel, pincushion})
    for (int u = 0; u < 640; u += 13)
      for (int v = 0; v < 480; v += 11) {
        const Eigen::Vector3d ray = camera.Undistort(Eigen::Vector2d(u, v));
        ASSERT_TRUE(ray.allFinite()) << u << " " << v;
        ASSERT_TRUE(MatrixNear(camera.Project(2.5 * ray), Eigen::Vector2d(u, v), 1e-8));
      }
}

TEST(Camera, ShowsNothingBehindItOrBeyondTheFold) {
  Camera camera{640, 480, 500, 500, 320, 240, {.k1 = -0.3}};
  EXPECT_TRUE(camera.Project({0, 0, -1}).hasNaN());
  EXPECT_TRUE(camera.Project({0, 0, 0}).hasNaN());
  // x (1 - 0.3 x^2) turns back at x = sqrt(1 / 0.9), where it is 0.7027.
  EXPECT_FALSE(camera.Project({1.05, 0, 1}).hasNaN());
  EXPECT_TRUE(camera.Project({1.06, 0, 1}).hasNaN());
  EXPECT_NEAR(camera.Undistort({320 + 500 * 0.70, 240}).x(), 1.00, 0.06);
  EXPECT_TRUE(camera.Undistort({320 + 500 * 0.71, 240}).hasNaN());
}

TEST(CameraYaml, OfOpenCvAndOfRosAreTheSameCamera) {
  ExpectSame(Read(kOpenCv), MadeUpCamera());
  ExpectSame(Read(kRos), MadeUpCamera());
}

TEST(CameraYaml, WrittenIsReadByOpenCvAndByUs) {
  Camera camera = MadeUpCamera();
  camera.fx_px = 650.0 + 1.0 / 3.0;
  camera.distortion.k6 = 0.125;
  const auto path = testing::ScratchDir() / "out.yaml";
  WriteCameraYaml(camera, path);
  ExpectSame(ReadCameraYaml(path), camera);
  const cv::FileStorage storage(path.string(), cv::FileStorage::READ);
  cv::Mat matrix, coefficients;
  storage["camera_matrix"] >> matrix;
  storage["distortion_coefficients"] >> coefficients;
  ASSERT_EQ(matrix.size(), cv::Size(3, 3));
  ASSERT_EQ(coefficients.size(), cv::Size(8, 1));
  EXPECT_EQ(matrix.at<double>(0, 0), camera.fx_px);
  EXPECT_EQ(matrix.at<double>(1, 2), camera.cy_px);
  EXPECT_EQ(coefficients.at<double>(0, 7), 0.125);
  EXPECT_EQ(static_cast<int>(storage["image_height"]), 480);
}

TEST(CameraYaml, WithoutDistortionHasNone) {
  const Camera camera = Read(
      "image_width: 4\nimage_height: 2\ncamera_matrix: {rows: 3, cols: 3, "
      "data: [5,0,2,0,5,1,0,0,1]}");
  EXPECT_EQ(camera.distortion.k1, 0);
  EXPECT_EQ(camera.fx_px, 5);
}

TEST(CameraYaml, RefusesToWriteAnImplausibleCamera) {
  EXPECT_THROW(WriteCameraYaml({}, testing::ScratchDir() / "x.yaml"), std::invalid_argument);
}

struct Flaw {
  const char* name;
  const char* from;
  const char* to;
  const char* message;
};

class FlawedCameraYaml : public ::testing::TestWithParam<Flaw> {};

TEST_P(FlawedCameraYaml, IsRefusedWithPlaceAndReason) {
  const Flaw& flaw = GetParam();
  EXPECT_THAT(Complaint(Replaced(kOpenCv, flaw.from, flaw.to)),
              AllOf(HasSubstr("camera.yaml:"), HasSubstr(flaw.message)));
}

INSTANTIATE_TEST_SUITE_P(
    All, FlawedCameraYaml,
    ::testing::Values(
        Flaw{"NoWidth", "image_width", "width", "found no image_width, wanted the YAML file"},
        Flaw{"ZeroWidth", "640", "0", "found the picture size 0 x 480"},
        Flaw{"HalfPixel", "640", "640.5", ":4: image_width: wanted one whole number"},
        Flaw{"NoMatrix", "camera_matrix", "K", "found no camera_matrix"},
        Flaw{"TwoMatrices", "extrinsic_parameters", "camera_matrix",
             ":22: found camera_matrix twice (first in line 11)"},
        Flaw{"NotANumber", "6.5e+02", ".Nan", ":11: found \".Nan\", wanted a number"},
        Flaw{"Negative", "6.5e+02", "-6.5e+02", "found the focal length -650 px"},
        Flaw{"TooLarge", "6.5e+02", "1e999", ":11: found \"1e999\""},
        Flaw{"Skew", "6.5e+02, 0.", "6.5e+02, 3.", "(no skew)"},
        Flaw{"EightNumbers", "651., ", "", "camera_matrix: found 8 numbers, wanted 9 (3 x 3)"},
        Flaw{"ManyNumbers", "651.", "1,1,1,1,1,1,1,1,1,1,1,1,1,1,1", "no more than 14 numbers"},
        Flaw{"FarCentre", "3.2025e+02", "3e+05", "found the principal point (300000, 240)"},
        Flaw{"Coefficients", "5.0e-03 ", "1,1", "found 6 numbers, wanted 0, 4, 5 or 8"},
        Flaw{"WildCoefficient", "5.0e-03", "1e8", "found the distortion coefficient 1e+08"},
        Flaw{"Fisheye", "flags: 0", "distortion_model: equidistant",
             ":6: found \"equidistant\", wanted the distortion model plumb_bob"}),
    [](const auto& param_info) { return param_info.param.name; });

TEST(CameraYaml, RefusesOtherFiles) {
  EXPECT_THAT(Complaint(""), HasSubstr("found no image_width"));
  EXPECT_THAT(Complaint("{\"format\": \"poselift-labels\"}"), HasSubstr("found no image_width"));
  EXPECT_THAT(Complaint(std::string("a\0b", 3)), HasSubstr("binary"));
  EXPECT_THROW(ReadCameraYaml(testing::ScratchDir()), InputError);
}

}  // namespace
}  // namespace poselift
