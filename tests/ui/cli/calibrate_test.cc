// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the program on photos of two cameras beside the project, whose focal lengths an optical
// motion capture system measured, and on rendered boards. Checked: both focal lengths within
// 0.3 %, less than 0.2 px rms, the photos without the whole board skipped and said so; what the
// program says of wrong counts, no board, mirrored pictures, other sizes, parallel views.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <regex>

#include "calib/april_grid.h"
#include "calib/april_grid_finder.h"
#include "calib/april_grid_yaml.h"
#include "calib/chessboard.h"
#include "src/io/camera_file.h"
#include "src/io/image.h"
#include "src/io/text_scanner.h"
#include "tests/support/board_picture.h"
#include "tests/support/planted_board_views.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::RunProgram;
using testing::ScratchDir;
using Json = nlohmann::json;

Json ReadJson(const std::string& file) { return Json::parse(ReadTextFile(ScratchDir() / file)); }

struct Focal {
  double x_px, y_px;
};

// The reference gives 64ths of a pixel.
Focal ReferenceFocal(const std::filesystem::path& file, const std::string& camera) {
  const std::string text = ReadTextFile(file);
  const std::regex pattern("serial=\"" + camera +
                           "\"[\\s\\S]*?focalLengthU=\"([0-9.]+)\" focalLengthV=\"([0-9.]+)\"");
  std::smatch match;
  if (!std::regex_search(text, match, pattern)) throw std::runtime_error("no " + camera);
  return {std::stod(match[1]) / 64.0, std::stod(match[2]) / 64.0};
}

class RealCamera : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(RealCamera, HasTheFocalLengthOfTheReference) {
  POSELIFT_DATA_OR_SKIP(data);
  const std::string camera = GetParam().first, without_board = GetParam().second;
  const auto run = RunProgram("calibrate " + (data / "calibration" / camera).string() +
                              " --board chessboard --corners 4x7 --square-mm 60 --out c.yaml"
                              " --json c.json");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr(without_board + "  skipped: "));
  const Json report = ReadJson("c.json");
  EXPECT_EQ(report["views_used"], 6);
  EXPECT_LT(report["rms_px"].get<double>(), 0.2);
  const Focal reference = ReferenceFocal(data / "calibration/Calib.qca.txt", camera);
  const Camera found = ReadCamera(ScratchDir() / "c.yaml");
  EXPECT_NEAR(found.fx_px / reference.x_px, 1.0, 0.003);
  EXPECT_NEAR(found.fy_px / reference.y_px, 1.0, 0.003);
  EXPECT_EQ(ReadImage(ScratchDir() / "c.coverage.png").empty(), false);
}

INSTANTIATE_TEST_SUITE_P(All, RealCamera,
                         ::testing::Values(std::pair{"cam02", "cam02_06_int.jpg"},
                                           std::pair{"cam04", "cam04_04_int.jpg"}),
                         [](const auto& param_info) {
                           return std::string(param_info.param.first);
                         });

TEST(RealCamera, WrongCountsAreMeasured) {
  POSELIFT_DATA_OR_SKIP(data);
  const std::string photos = (data / "calibration/cam02").string();
  const auto run = RunProgram("calibrate " + photos + "/cam02_01_int.jpg " + photos +
                              "/cam02_04_int.jpg --corners 5x8 --square-mm 60");
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("I see 4 x 7 inner corners in 2 of 2 pictures, you said 5 x 8"));
  EXPECT_THAT(run.err, HasSubstr("not the squares"));
}

TEST(RealCamera, ABoardSaidSmallerOrLargerIsSeenAsItIs) {
  POSELIFT_DATA_OR_SKIP(data);
  const std::string photo = (data / "calibration/cam02/cam02_0").string();
  const std::string photos = photo + "1_int.jpg " + photo + "2_int.jpg " + photo + "7_int.jpg ";
  for (const char* said : {"3x6", "3x7", "4x8"}) {
    const auto run = RunProgram("calibrate " + photos + "--corners " + said + " --square-mm 60");
    EXPECT_EQ(run.code, 1) << said;
    EXPECT_THAT(run.err, HasSubstr("I see 4 x 7 inner corners in 3 of 3 pictures")) << said;
    EXPECT_THAT(run.err, HasSubstr("say 4 x 7")) << said;
  }
}

// Rendered views, as pictures 1.png, 2.png, ... in a folder.
Camera SmallCamera() { return {640, 480, 560.0, 560.0, 322.0, 238.0, {.k1 = -0.1, .k2 = 0.03}}; }

void WriteViews(const CalibrationBoard& board, const testing::BoardPrint& print, int count,
                double largest_tilt_rad, bool mirrored, const std::string& folder) {
  auto rng = testing::TestRng();
  const auto planted = testing::PlantBoardViews(
      board, SmallCamera(), {.num_views = count, .largest_tilt_rad = largest_tilt_rad}, &rng);
  std::filesystem::create_directories(ScratchDir() / folder);
  int number = 0;
  for (const Eigen::Isometry3d& pose : planted.cam_from_board) {
    cv::Mat picture = testing::RenderBoard(print, SmallCamera(), pose);
    if (mirrored) cv::flip(picture, picture, 1);
    WritePng(ScratchDir() / folder / (std::to_string(++number) + ".png"), picture);
  }
}

const Chessboard kChess{5, 7, 0.03};
const AprilGrid kGrid{3, 4, 0.03, 0.3, 0, "tag36h11"};

TEST(Calibrate, AChessboardGivesThePlantedCameraInRosFormToo) {
  WriteViews(kChess.Board(), testing::PrintOf(kChess), 8, 0.7, false, "views");
  WritePng(ScratchDir() / "views" / "small.png", cv::Mat(100, 120, CV_8UC1, cv::Scalar(90)));
  const auto run =
      RunProgram("calibrate views --corners 7x5 --square-mm 30 --out camera_info.yaml --name cam");
  ASSERT_EQ(run.code, 0) << run.err << run.out;
  EXPECT_THAT(run.out,
              HasSubstr("small.png  skipped: 120 x 100 pixels, the others have 640 x 480"));
  EXPECT_THAT(ReadTextFile(ScratchDir() / "camera_info.yaml"), HasSubstr("camera_name: cam\n"));
  EXPECT_NEAR(ReadCamera(ScratchDir() / "camera_info.yaml").fx_px, 560.0, 1.5);
  const auto info = RunProgram("info camera_info.yaml");
  EXPECT_EQ(info.code, 0) << info.err;
}

TEST(Calibrate, AnAprilGridIsDescribedByOptionsOrByKalibrsFile) {
  WriteViews(BoardOf(kGrid), testing::PrintOf(kGrid), 8, 0.7, false, "views");
  WriteAprilGridYaml(kGrid, ScratchDir() / "grid.yaml");
  for (const char* board : {"--tags 3x4 --tag-mm 30", "--target grid.yaml"}) {
    const auto run = RunProgram(std::string("calibrate views --board aprilgrid ") + board);
    ASSERT_EQ(run.code, 0) << run.err << run.out;
    EXPECT_NEAR(ReadCamera(ScratchDir() / "camera.yaml").fx_px, 560.0, 1.5);
  }
  const auto wrong = RunProgram("calibrate views --board aprilgrid --tags 4x3 --tag-mm 30");
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.err,
              HasSubstr("I see 3 x 4 tags in 8 of 8 pictures, you said 4 x 3; rows and columns "
                        "are exchanged"));
  const auto less = RunProgram("calibrate views --board aprilgrid --tags 2x4 --tag-mm 30");
  EXPECT_EQ(less.code, 1);
  EXPECT_THAT(less.err, HasSubstr("I see 3 x 4 tags in 8 of 8 pictures, you said 2 x 4"));
  const auto ids =
      RunProgram("calibrate views --board aprilgrid --tags 3x4 --tag-mm 30 --first-id 50");
  EXPECT_EQ(ids.code, 1);
  EXPECT_THAT(ids.err, HasSubstr("I see tags of tag36h11 with ids 0 to 11 in 8 of 8 pictures"));
}

TEST(Calibrate, MirroredPicturesAreToldFromPicturesWithoutABoard) {
  WriteViews(BoardOf(kGrid), testing::PrintOf(kGrid), 3, 0.5, true, "mirrored");
  const std::string board = " --board aprilgrid --tags 3x4 --tag-mm 30";
  const auto mirrored = RunProgram("calibrate mirrored" + board);
  EXPECT_EQ(mirrored.code, 1);
  EXPECT_THAT(mirrored.err, HasSubstr("the pictures are mirrored"));
  WritePng(ScratchDir() / "grey.png", cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)));
  for (const std::string& none : {board, std::string(" --corners 4x7 --square-mm 60")}) {
    const auto run = RunProgram("calibrate grey.png" + none);
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("no board is visible in any of 1 pictures"));
    EXPECT_FALSE(std::filesystem::exists(ScratchDir() / "camera.yaml"));
  }
}

TEST(Calibrate, ParallelViewsAreRefused) {
  WriteViews(kChess.Board(), testing::PrintOf(kChess), 5, 0.02, false, "views");
  const auto run = RunProgram("calibrate views --corners 5x7 --square-mm 30 --json r.json");
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("turned the same way in all 5 views"));
  EXPECT_FALSE(ReadJson("r.json")["done"].get<bool>());
  EXPECT_FALSE(std::filesystem::exists(ScratchDir() / "camera.yaml"));
}

TEST(Calibrate, AVideoIsCalibratedFromFewOfItsFrames) {
  // The board stands still at eight places, half a second each.
  auto rng = testing::TestRng();
  const auto planted =
      testing::PlantBoardViews(kChess.Board(), SmallCamera(), {.num_views = 8}, &rng);
  const std::string path = ScratchDir() / "board.avi";
  cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 8.0, {640, 480});
  ASSERT_TRUE(writer.isOpened());
  for (const Eigen::Isometry3d& pose : planted.cam_from_board) {
    cv::Mat picture;
    cv::cvtColor(testing::RenderBoard(testing::PrintOf(kChess), SmallCamera(), pose), picture,
                 cv::COLOR_GRAY2BGR);
    for (int i = 0; i < 4; ++i) writer.write(picture);
  }
  writer.release();
  const auto run = RunProgram("calibrate board.avi --corners 5x7 --square-mm 30 --json r.json");
  ASSERT_EQ(run.code, 0) << run.err << run.out;
  const Json report = ReadJson("r.json");
  EXPECT_GE(report["views_used"], 6);
  EXPECT_LE(report["views_used"], 8);
  EXPECT_NEAR(ReadCamera(ScratchDir() / "camera.yaml").fx_px, 560.0, 3.0);
}

TEST(Calibrate, APictureThatIsCutShortIsSkippedByItsName) {
  WriteViews(kChess.Board(), testing::PrintOf(kChess), 5, 0.7, false, "views");
  std::vector<uchar> jpeg;
  cv::imencode(".jpg", ReadImage(ScratchDir() / "views/1.png"), jpeg);
  testing::WriteScratch("views/short.jpg",
                        std::string(jpeg.begin(), jpeg.begin() + jpeg.size() / 2));
  const auto run = RunProgram("calibrate views --corners 5x7 --square-mm 30");
  EXPECT_THAT(run.out, HasSubstr("short.jpg: is a damaged picture"));
  EXPECT_EQ(RunProgram("calibrate views/short.jpg --corners 5x7 --square-mm 30").code, 3);
}

TEST(Calibrate, WrongUsageAndUnreadableInputHaveTheirCodes) {
  EXPECT_EQ(RunProgram("calibrate nowhere --corners 4x7 --square-mm 60").code, 3);
  EXPECT_EQ(RunProgram("calibrate . --corners 4x7 --square-mm 60").code, 3);
  EXPECT_EQ(RunProgram("calibrate .").code, 2);
  EXPECT_EQ(RunProgram("calibrate . --corners 4 --square-mm 60").code, 2);
  EXPECT_EQ(RunProgram("calibrate . --corners 4x7x --square-mm 60").code, 2);
  EXPECT_EQ(RunProgram("calibrate . --board aprilgrid --corners 4x7").code, 2);
  for (const char* const ignored : {"--tag-mm 20", "--corners 4x7"}) {
    const auto run =
        RunProgram(std::string("calibrate . --board aprilgrid --target t.yaml ") + ignored);
    EXPECT_EQ(run.code, 2) << ignored;
    EXPECT_NE(run.err.find("says nothing here"), std::string::npos) << run.err;
  }
  const auto none = RunProgram("calibrate . --corners 4x7 --square-mm 0");
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("found 0, wanted"));
  const auto small = RunProgram("calibrate . --corners 2x7 --square-mm 60");
  EXPECT_EQ(small.code, 3);
  EXPECT_THAT(small.err, HasSubstr("2 x 7 inner corners, wanted 3 to 50"));
}

}  // namespace
}  // namespace poselift
