// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Faked: views of a board at planted places and tilts. Checked: cells, tilts with their signs,
// sizes, and hints that name what is missing until nothing is; the picture has what it says.
#include "calib/calibration_coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/calibration_picture.h"
#include "calib/chessboard.h"
#include "tests/support/pictures.h"
#include "tests/support/planted_board_views.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const Chessboard kChess{5, 8, 0.03};
const Camera kCamera{1280, 720, 900.0, 900.0, 639.5, 359.5, {}};

Eigen::Isometry3d Before(double x_m, double y_m, double z_m, const Eigen::Vector3d& turn_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (turn_rad.norm() > 0)
    pose.linear() = Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).toRotationMatrix();
  pose.translation() =
      Eigen::Vector3d(x_m, y_m, z_m) - pose.linear() * Eigen::Vector3d(0.105, 0.06, 0.0);
  return pose;
}

BoardView See(const Eigen::Isometry3d& pose) {
  const CalibrationBoard board = kChess.Board();
  BoardView view;
  view.corners_px.resize(2, board.num_corners());
  for (int id = 0; id < board.num_corners(); ++id) {
    view.ids.push_back(id);
    view.corners_px.col(id) =
        kCamera.Project(pose * Eigen::Vector3d(board.corners_in_board_m(0, id),
                                               board.corners_in_board_m(1, id), 0));
  }
  return view;
}

CalibrationCoverage CoverageAt(const Eigen::Isometry3d& pose) {
  const BoardView view = See(pose);
  return CoverageOf(kChess.Board(), {&view}, {pose}, kCamera);
}

TEST(CalibrationCoverageTest, CountsCornersByCell) {
  const CalibrationCoverage coverage = CoverageAt(Before(-0.3, -0.15, 0.6, {0, 0, 0}));
  EXPECT_EQ(coverage.corners.sum(), 40);
  EXPECT_EQ(coverage.corners.bottomRows(3).sum(), 0);
  EXPECT_GT(coverage.corners.topLeftCorner(3, 3).sum(), 30);
  EXPECT_THAT(coverage.hints, Contains(HasSubstr("to the lower right")));
  EXPECT_THAT(coverage.hints, Not(Contains(HasSubstr("to the upper left"))));
  EXPECT_THAT(coverage.hints, Contains("show 9 more views"));
}

// The board's frame is the camera's when upright: turned by +y its right edge goes away.
TEST(CalibrationCoverageTest, TiltSaysWhichEdgeIsNearer) {
  const double tilt_rad = 0.5;
  EXPECT_NEAR(CoverageAt(Before(0, 0, 0.6, {0, -tilt_rad, 0})).left_rad, tilt_rad, 1e-9);
  EXPECT_NEAR(CoverageAt(Before(0, 0, 0.6, {0, tilt_rad, 0})).right_rad, tilt_rad, 1e-9);
  EXPECT_NEAR(CoverageAt(Before(0, 0, 0.6, {tilt_rad, 0, 0})).up_rad, tilt_rad, 1e-9);
  EXPECT_NEAR(CoverageAt(Before(0, 0, 0.6, {-tilt_rad, 0, 0})).down_rad, tilt_rad, 1e-9);
  // Which edge it is, by its depth.
  const Eigen::Isometry3d right = Before(0, 0, 0.6, {0, tilt_rad, 0});
  EXPECT_LT((right * Eigen::Vector3d(0.21, 0.06, 0)).z(),
            (right * Eigen::Vector3d(0, 0.06, 0)).z());
  const Eigen::Isometry3d up = Before(0, 0, 0.6, {tilt_rad, 0, 0});
  EXPECT_LT((up * Eigen::Vector3d(0.1, 0, 0)).z(), (up * Eigen::Vector3d(0.1, 0.12, 0)).z());
}

TEST(CalibrationCoverageTest, ManyViewsOfAllKindsAreEnough) {
  auto rng = testing::TestRng();
  const auto planted = testing::PlantBoardViews(kChess.Board(), kCamera,
                                                {.num_views = 60, .may_leave_picture = true}, &rng);
  std::vector<const BoardView*> views;
  for (const BoardView& view : planted.views) views.push_back(&view);
  const CalibrationCoverage known =
      CoverageOf(kChess.Board(), views, planted.cam_from_board, kCamera);
  EXPECT_TRUE(known.hints.empty()) << known.hints.front();
  EXPECT_GT(known.share, 0.9);
  // And with the camera guessed.
  EXPECT_TRUE(CoverageOf(kChess.Board(), views, 1280, 720).hints.empty());
  EXPECT_EQ(CoverageOf(kChess.Board(), {}, 1280, 720).num_views, 0);
}

TEST(CalibrationPicture, ShowsCellsCornersAndArrows) {
  auto rng = testing::TestRng();
  const auto planted = testing::PlantBoardViews(kChess.Board(), kCamera, {.num_views = 6}, &rng);
  const CalibrationResult result = CalibrateCamera(kChess.Board(), planted.views, {1280, 720});
  ASSERT_TRUE(result.IsUsable());
  std::vector<const BoardView*> views;
  for (const BoardView& view : planted.views) views.push_back(&view);
  const CalibrationCoverage coverage =
      CoverageOf(kChess.Board(), views, planted.cam_from_board, result.camera);
  const cv::Mat picture = DrawCalibration(planted.views, result, coverage, "a title");
  const cv::Mat nothing = DrawCalibration({}, result, {}, "a title");
  ASSERT_EQ(picture.size(), nothing.size());
  // At a corner that was seen: dark; the same place without views is paper.
  const double scale = 1000.0 / 1280.0;
  const Eigen::Vector2d at = Eigen::Vector2d(24, 84) + scale * (planted.views[0].corners_px.col(3) +
                                                                Eigen::Vector2d::Constant(0.5));
  EXPECT_LT(testing::At(picture, at.x(), at.y())[1], 150);
  EXPECT_GT(testing::At(nothing, at.x(), at.y())[1], 200);
}

}  // namespace
}  // namespace poselift
