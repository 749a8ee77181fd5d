// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the solver. Faked: the corners, seen by a planted camera with Gaussian noise.
// Checked: the planted camera comes back within its stated uncertainty, no more distortion is
// found than there is, bad views are dropped, views that cannot say the focal length are told.
#include "calib/camera_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "calib/april_grid.h"
#include "calib/april_grid_finder.h"
#include "calib/chessboard.h"
#include "tests/support/planted_board_views.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::PlantBoardViews;
using testing::TestRng;

const cv::Size kSize_px(1280, 720);

CalibrationBoard Chess() { return Chessboard{5, 8, 0.03}.Board(); }

Camera Webcam() {
  Camera camera{kSize_px.width, kSize_px.height, 912.0, 908.0, 655.0, 351.0, {}};
  camera.distortion = {.k1 = 0.11, .k2 = -0.23, .p1 = 0.0015, .p2 = -0.001};
  return camera;
}

TEST(CameraCalibration, ExactCornersGiveTheExactCamera) {
  auto rng = TestRng();
  const auto planted = PlantBoardViews(Chess(), Webcam(), {.num_views = 10, .noise_px = 0.0}, &rng);
  const CalibrationResult result =
      CalibrateCamera(Chess(), planted.views, kSize_px, {.lens = LensModel::kK1K2P1P2});
  ASSERT_TRUE(result.IsUsable()) << result.BriefReport();
  EXPECT_TRUE(testing::MatrixNear(ParametersOf(result.camera), ParametersOf(Webcam()), 1e-5));
  EXPECT_LT(result.rms_px, 1e-6);
  for (size_t v = 0; v < planted.views.size(); ++v)
    EXPECT_TRUE(testing::MatrixNear(result.views[v].cam_from_board.matrix(),
                                    planted.cam_from_board[v].matrix(), 1e-6));
}

// Over many seeds the errors in units of their stated sigmas are standard normal numbers.
TEST(CameraCalibration, ErrorsAreAsLargeAsTheirStatedSigmas) {
  auto rng = TestRng();
  constexpr int kSeeds = 40;
  double sum = 0.0, num = 0.0;
  int beyond_three = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto planted = PlantBoardViews(Chess(), Webcam(), {.num_views = 12}, &rng);
    const CalibrationResult result =
        CalibrateCamera(Chess(), planted.views, kSize_px, {.lens = LensModel::kK1K2P1P2});
    ASSERT_TRUE(result.IsUsable()) << result.BriefReport();
    EXPECT_EQ(result.num_used(), 12);
    EXPECT_NEAR(result.corner_sigma_px, 0.1, 0.02);
    const CameraParameters error = ParametersOf(result.camera) - ParametersOf(Webcam());
    for (int i = 0; i < NumFreeParameters(result.lens); ++i) {
      const double z = error[i] / result.sigma[i];
      EXPECT_LT(std::abs(z), 5.0) << CameraParameterNames()[static_cast<size_t>(i)];
      beyond_three += std::abs(z) > 3.0 ? 1 : 0;
      sum += z * z;
      num += 1.0;
    }
  }
  EXPECT_NEAR(std::sqrt(sum / num), 1.0, 0.15);
  EXPECT_LE(beyond_three, 4);  // of 320; 0.9 are expected
}

TEST(CameraCalibration, ViewsLeftOutTellTheSameSigmasAsTheNoise) {
  auto rng = TestRng();
  CameraParameters ratio = CameraParameters::Zero();
  constexpr int kSeeds = 10;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto planted = PlantBoardViews(Chess(), Webcam(), {.num_views = 20}, &rng);
    const CalibrationResult result =
        CalibrateCamera(Chess(), planted.views, kSize_px, {.lens = LensModel::kK1K2P1P2});
    ASSERT_TRUE(result.IsUsable()) << result.BriefReport();
    ratio.head<8>() += (result.view_sigma.cwiseQuotient(result.sigma)).head<8>() / kSeeds;
  }
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(ratio[i], 1.15, 0.4) << i;
}

TEST(CameraCalibration, FindsAsManyDistortionCoefficientsAsThereAre) {
  auto rng = TestRng();
  Camera none = Webcam(), k1 = Webcam();
  none.distortion = {};
  k1.distortion = {.k1 = -0.2};
  const std::pair<Camera, LensModel> cases[] = {
      {none, LensModel::kPinhole}, {k1, LensModel::kK1}, {Webcam(), LensModel::kK1K2P1P2}};
  for (const auto& [camera, lens] : cases) {
    int num_right = 0;
    for (int seed = 0; seed < 5; ++seed) {
      const auto planted = PlantBoardViews(Chess(), camera, {.num_views = 16}, &rng);
      const CalibrationResult result = CalibrateCamera(Chess(), planted.views, kSize_px);
      ASSERT_TRUE(result.IsUsable()) << result.BriefReport();
      num_right += result.lens == lens ? 1 : 0;
    }
    EXPECT_GE(num_right, 4) << LensModelName(lens);
  }
}

TEST(CameraCalibration, DropsAViewWithWrongLabels) {
  auto rng = TestRng();
  auto planted = PlantBoardViews(Chess(), Webcam(), {.num_views = 9}, &rng);
  // Two neighbouring rows of corners exchanged.
  BoardView& wrong = planted.views[4];
  for (Eigen::Index i = 0; i < 8; ++i) wrong.corners_px.col(i).swap(wrong.corners_px.col(8 + i));
  const CalibrationResult result = CalibrateCamera(Chess(), planted.views, kSize_px);
  ASSERT_TRUE(result.IsUsable()) << result.BriefReport();
  for (size_t v = 0; v < planted.views.size(); ++v) EXPECT_EQ(result.views[v].is_used, v != 4) << v;
  EXPECT_GT(result.views[4].rms_px, 5.0);
  EXPECT_LT(std::abs(result.camera.fx_px - 912.0), 4.0 * result.sigma[0]);
  EXPECT_LT(result.rms_px, 0.2);
}

TEST(CameraCalibration, AFewWrongCornersMoveTheCameraLittle) {
  auto rng = TestRng();
  auto planted = PlantBoardViews(Chess(), Webcam(), {.num_views = 12}, &rng);
  for (BoardView& view : planted.views) view.corners_px.col(7) += Eigen::Vector2d(0.6, -0.4);
  const CalibrationResult result =
      CalibrateCamera(Chess(), planted.views, kSize_px, {.lens = LensModel::kK1K2P1P2});
  ASSERT_TRUE(result.IsUsable()) << result.BriefReport();
  EXPECT_LT(std::abs(result.camera.fx_px - 912.0), 5.0 * result.sigma[0]);
}

TEST(CameraCalibration, PartlyVisibleBoardsCount) {
  auto rng = TestRng();
  const auto planted =
      PlantBoardViews(Chess(), Webcam(), {.num_views = 15, .may_leave_picture = true}, &rng);
  EXPECT_TRUE(std::any_of(planted.views.begin(), planted.views.end(),
                          [](const BoardView& view) { return view.ids.size() < 40; }));
  const CalibrationResult result =
      CalibrateCamera(Chess(), planted.views, kSize_px, {.lens = LensModel::kK1K2P1P2});
  ASSERT_TRUE(result.IsUsable()) << result.BriefReport();
  EXPECT_EQ(result.num_used(), 15);
  EXPECT_LT(std::abs(result.camera.fx_px - 912.0), 4.0 * result.sigma[0]);
}

TEST(CameraCalibration, ALongLensAndAWideOneStartFromNothingToo) {
  auto rng = TestRng();
  for (const double f_px : {420.0, 5000.0}) {
    Camera camera = Webcam();
    camera.fx_px = camera.fy_px = f_px;
    camera.distortion = {.k1 = -0.1};
    const auto planted = PlantBoardViews(Chess(), camera, {.num_views = 14}, &rng);
    const CalibrationResult result = CalibrateCamera(Chess(), planted.views, kSize_px);
    ASSERT_TRUE(result.IsUsable()) << f_px << " " << result.BriefReport();
    EXPECT_LT(std::abs(result.camera.fx_px - f_px), 5.0 * result.sigma[0]) << f_px;
  }
}

TEST(CameraCalibration, ParallelViewsDoNotTellTheFocalLength) {
  auto rng = TestRng();
  const auto planted =
      PlantBoardViews(Chess(), Webcam(), {.num_views = 10, .largest_tilt_rad = 0.01}, &rng);
  const CalibrationResult result = CalibrateCamera(Chess(), planted.views, kSize_px);
  EXPECT_EQ(result.status, CalibrationStatus::kViewsParallel) << result.BriefReport();
  EXPECT_THAT(result.BriefReport(), HasSubstr("tilt it"));
}

TEST(CameraCalibration, HardlyTiltedViewsLeaveTheFocalLengthOpen) {
  auto rng = TestRng();
  const auto planted = PlantBoardViews(
      Chess(), Webcam(), {.num_views = 5, .noise_px = 0.5, .largest_tilt_rad = 0.12}, &rng);
  const CalibrationResult result =
      CalibrateCamera(Chess(), planted.views, kSize_px, {.least_turn_rad = 0.0});
  EXPECT_EQ(result.status, CalibrationStatus::kFocalUnknown) << result.BriefReport();
}

TEST(CameraCalibration, GapsOfAnotherBoardAreSaid) {
  auto rng = TestRng();
  const AprilGrid grid{.rows = 5, .columns = 7, .tag_size_m = 0.03, .spacing = 0.3};
  const auto planted =
      PlantBoardViews(AprilGridFinder(grid).board(), Webcam(), {.num_views = 12}, &rng);
  for (const double said : {0.2, 0.5}) {
    AprilGrid wrong = grid;
    wrong.spacing = said;
    const CalibrationResult result =
        CalibrateCamera(AprilGridFinder(wrong).board(), planted.views, kSize_px);
    EXPECT_EQ(result.status, CalibrationStatus::kBoardMisfits) << result.BriefReport();
    EXPECT_THAT(result.BriefReport(), HasSubstr("gaps"));
  }
  EXPECT_TRUE(CalibrateCamera(AprilGridFinder(grid).board(), planted.views, kSize_px).IsUsable());
}

TEST(CameraCalibration, TooFewViewsAreSaid) {
  auto rng = TestRng();
  auto planted = PlantBoardViews(Chess(), Webcam(), {.num_views = 2}, &rng);
  planted.views.push_back({{1, 2}, Eigen::Matrix2Xd::Random(2, 2)});
  const CalibrationResult result = CalibrateCamera(Chess(), planted.views, kSize_px);
  EXPECT_EQ(result.status, CalibrationStatus::kTooFewViews);
  EXPECT_EQ(CalibrateCamera(Chess(), {}, kSize_px).status, CalibrationStatus::kTooFewViews);
}

TEST(CameraCalibration, OptionsAndIdsOutOfRangeAreRefused) {
  EXPECT_THROW(CalibrateCamera(Chess(), {}, kSize_px, {.bad_view_ratio = 0.5}),
               std::invalid_argument);
  EXPECT_THROW(CalibrateCamera(Chess(), {{{40}, Eigen::Matrix2Xd::Zero(2, 1)}}, kSize_px),
               std::invalid_argument);
}

}  // namespace
}  // namespace poselift
