// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the finder on rendered boards, through a lens with distortion. Checked: corners where
// they were planted, whose pixels' centres are integers; counts that are wrong are told from
// boards that are not there.
#include "calib/chessboard.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "calib/camera_refinement.h"
#include "src/input_error.h"
#include "tests/support/board_picture.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

const Chessboard kBoard{4, 7, 0.06};

Camera SmallCamera() { return {800, 600, 700.0, 700.0, 401.0, 297.0, {.k1 = -0.12, .k2 = 0.05}}; }

Eigen::Isometry3d Before(double x_m, double y_m, double z_m, double tilt_rad, double roll_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d(0.6, 0.8, 0.0)) *
                   Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  pose.translation() =
      Eigen::Vector3d(x_m, y_m, z_m) - pose.linear() * Eigen::Vector3d(0.18, 0.09, 0);
  return pose;
}

cv::Mat Picture(const Eigen::Isometry3d& cam_from_board) {
  cv::Mat picture = testing::RenderBoard(testing::PrintOf(kBoard), SmallCamera(), cam_from_board);
  cv::GaussianBlur(picture, picture, {}, 0.7);
  return picture;
}

// A board and the same turned by half a turn look alike.
Eigen::Matrix2Xd ErrorOf_px(const BoardView& view, const Eigen::Isometry3d& cam_from_board) {
  BoardView turned = view;
  turned.corners_px = view.corners_px.rowwise().reverse();
  const auto residuals = [&](const BoardView& v) {
    return BoardResiduals_px(kBoard.Board(), v, SmallCamera(), cam_from_board);
  };
  const Eigen::Matrix2Xd a = residuals(view), b = residuals(turned);
  return a.norm() < b.norm() ? a : b;
}

TEST(ChessboardTest, CornersAreFoundWhereTheyWerePlanted) {
  ChessboardFinder finder(kBoard);
  for (const auto& pose : {Before(0, 0, 0.55, 0.0, 0.1), Before(0.05, -0.03, 0.6, 0.6, 0.4),
                           Before(-0.1, 0.05, 0.9, -0.5, 1.3), Before(0, 0, 0.7, 0.4, 3.0)}) {
    const BoardView view = finder.Find(Picture(pose));
    ASSERT_EQ(view.ids.size(), 28u);
    const Eigen::Matrix2Xd error_px = ErrorOf_px(view, pose);
    EXPECT_LT(error_px.colwise().norm().maxCoeff(), 0.06);
    EXPECT_LT(error_px.rowwise().mean().norm(), 0.01);  // no shift by half a pixel
  }
}

TEST(ChessboardTest, RowsAndColumnsMayBeExchanged) {
  ChessboardFinder finder({7, 4, 0.06});
  EXPECT_EQ(finder.Find(Picture(Before(0, 0, 0.6, 0.3, 0.1))).ids.size(), 28u);
}

TEST(ChessboardTest, WrongCountsAreSeen) {
  const cv::Mat picture = Picture(Before(0, 0, 0.6, 0.3, 0.1));
  for (const BoardCounts& wrong :
       {BoardCounts{5, 8}, {4, 6}, {3, 7}, {4, 8}, {5, 7}, {3, 6}, {6, 9}}) {
    ChessboardFinder finder({wrong.rows, wrong.columns, 0.06});
    EXPECT_TRUE(finder.Find(picture).empty()) << wrong.rows << " x " << wrong.columns;
    const BoardAbsence absence = finder.Explain(picture);
    ASSERT_TRUE(absence.seen.has_value());
    EXPECT_EQ(*absence.seen, (BoardCounts{4, 7})) << wrong.rows << " x " << wrong.columns;
  }
}

// Where the finder takes a part for the board, the view says so; else the board is seen whole.
TEST(ChessboardTest, APartOfALargerBoardIsNoBoard) {
  const cv::Mat picture = Picture(Before(0, 0, 0.6, 0.3, 0.1));
  for (const BoardCounts& part : {BoardCounts{3, 3}, {4, 4}, {4, 5}, {3, 5}}) {
    ChessboardFinder finder({part.rows, part.columns, 0.06});
    const BoardView view = finder.Find(picture);
    const auto seen = view.empty() ? finder.Explain(picture).seen : view.part_of;
    EXPECT_EQ(seen, (BoardCounts{4, 7})) << part.rows << " x " << part.columns;
  }
  EXPECT_FALSE(ChessboardFinder(kBoard).Find(picture).part_of.has_value());
}

TEST(ChessboardTest, NoBoardIsSeenWhereThereIsNone) {
  ChessboardFinder finder(kBoard);
  cv::Mat noise(480, 640, CV_8UC1);
  cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 255);
  for (const cv::Mat& picture : {cv::Mat(480, 640, CV_8UC1, cv::Scalar(128)), noise}) {
    EXPECT_TRUE(finder.Find(picture).empty());
    EXPECT_FALSE(finder.Explain(picture).seen.has_value());
  }
}

TEST(ChessboardTest, ABoardThatLeavesThePictureIsSeenInPart) {
  ChessboardFinder finder(kBoard);
  const cv::Mat picture = Picture(Before(-0.21, 0, 0.6, 0.0, 0.0));
  EXPECT_TRUE(finder.Find(picture).empty());
  const BoardAbsence absence = finder.Explain(picture);
  ASSERT_TRUE(absence.seen.has_value());
  EXPECT_LT(absence.seen->rows * absence.seen->columns, 28);
}

TEST(ChessboardTest, TinyPicturesAndImpossibleBoardsAreRefused) {
  ChessboardFinder finder(kBoard);
  EXPECT_TRUE(finder.Find(cv::Mat(1, 1, CV_8UC1, cv::Scalar(0))).empty());
  EXPECT_FALSE(finder.Explain(cv::Mat(3, 2, CV_8UC1, cv::Scalar(0))).seen.has_value());
  EXPECT_THROW(ChessboardFinder({2, 7, 0.06}), InputError);
  EXPECT_THROW(ChessboardFinder({4, 7, 0.0}), InputError);
}

}  // namespace
}  // namespace poselift
