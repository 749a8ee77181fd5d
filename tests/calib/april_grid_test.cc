// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the tag detector on rendered grids, through a lens with distortion. Checked: Kalibr's
// numbering, corners where they were planted, part of a grid, mirrored pictures, wrong counts;
// the target's file.
#include "calib/april_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "calib/april_grid_finder.h"
#include "calib/april_grid_yaml.h"
#include "calib/board_survey.h"
#include "calib/camera_calibration.h"
#include "calib/camera_refinement.h"
#include "src/input_error.h"
#include "tests/support/board_picture.h"
#include "tests/support/planted_board_views.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::WriteScratch;

AprilGrid Grid() { return {4, 5, 0.04, 0.3, 7, "tag36h11"}; }

Camera SmallCamera() { return {800, 600, 700.0, 700.0, 401.0, 297.0, {.k1 = -0.12, .k2 = 0.05}}; }

Eigen::Isometry3d Before(double x_m, double y_m, double z_m, double tilt_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d(0.6, 0.8, 0.0)).toRotationMatrix();
  pose.translation() =
      Eigen::Vector3d(x_m, y_m, z_m) -
      pose.linear() * Eigen::Vector3d(0.5 * Grid().Width_m(), 0.5 * Grid().Height_m(), 0.0);
  return pose;
}

cv::Mat Picture(const Eigen::Isometry3d& pose) {
  return testing::RenderBoard(testing::PrintOf(Grid()), SmallCamera(), pose);
}

TEST(AprilGridTest, IdsGoFromTheBottomLeftToTheRightAndUpwards) {
  const AprilGrid grid = Grid();
  EXPECT_TRUE(testing::MatrixNear(grid.TopLeft_m(7), Eigen::Vector2d(0.0, 0.156), 1e-12));
  EXPECT_TRUE(testing::MatrixNear(grid.TopLeft_m(8), Eigen::Vector2d(0.052, 0.156), 1e-12));
  EXPECT_TRUE(testing::MatrixNear(grid.TopLeft_m(12), Eigen::Vector2d(0.0, 0.104), 1e-12));
  EXPECT_TRUE(testing::MatrixNear(grid.TopLeft_m(26), Eigen::Vector2d(0.208, 0.0), 1e-12));
  EXPECT_FALSE(grid.Has(6));
  EXPECT_FALSE(grid.Has(27));
}

TEST(AprilGridTest, CornersAreFoundWhereTheyWerePlanted) {
  AprilGridFinder finder(Grid());
  for (const auto& pose : {Before(0, 0, 0.4, 0.1), Before(0.03, 0.02, 0.45, 0.6)}) {
    const BoardView view = finder.Find(Picture(pose));
    ASSERT_EQ(view.ids.size(), 80u);
    const Eigen::Matrix2Xd error_px = BoardResiduals_px(finder.board(), view, SmallCamera(), pose);
    EXPECT_LT(error_px.colwise().norm().maxCoeff(), 0.15);
    EXPECT_LT(error_px.rowwise().mean().norm(), 0.02);
  }
}

// Two cells of black around the bits, and a black square in each gap's corners, which touch the
// tags'.
TEST(AprilGridTest, MostOfKalibrsPrintIsFound) {
  AprilGrid grid = Grid();
  grid.family = "tag36h11b2";
  const double gap_m = grid.Pitch_m() - grid.tag_size_m;
  const auto print = [&, tags = testing::PrintOf(grid)](const Eigen::Vector2d& x_in_board_m) {
    const auto from_gap_m = [&](double x_m) {
      return x_m + gap_m - grid.Pitch_m() * std::floor((x_m + gap_m) / grid.Pitch_m());
    };
    const bool in_square =
        x_in_board_m.minCoeff() > -gap_m && x_in_board_m.x() < grid.Width_m() + gap_m &&
        x_in_board_m.y() < grid.Height_m() + gap_m && from_gap_m(x_in_board_m.x()) < gap_m &&
        from_gap_m(x_in_board_m.y()) < gap_m;
    return in_square ? 30.0 : tags(x_in_board_m);
  };
  AprilGridFinder finder(grid), other(Grid());
  for (const auto& pose : {Before(0, 0, 0.4, 0.1), Before(0.03, 0.02, 0.45, 0.6)}) {
    const cv::Mat picture = testing::RenderBoard(print, SmallCamera(), pose);
    const BoardView view = finder.Find(picture);
    EXPECT_GE(view.ids.size(), 40u);  // of 80: squares that touch a tag hide it from libapriltag
    const Eigen::Matrix2Xd error_px = BoardResiduals_px(finder.board(), view, SmallCamera(), pose);
    EXPECT_LT(error_px.colwise().norm().maxCoeff(), 0.15);
    EXPECT_LT(error_px.rowwise().mean().norm(), 0.02);
    EXPECT_TRUE(other.Find(picture).empty());
  }
}

TEST(AprilGridTest, PartOfAGridCounts) {
  AprilGridFinder finder(Grid());
  const auto pose = Before(0.22, 0.12, 0.4, 0.2);
  const BoardView view = finder.Find(Picture(pose));
  EXPECT_GE(view.ids.size(), 8u);
  EXPECT_LT(view.ids.size(), 80u);
  EXPECT_LT(RmsOf(BoardResiduals_px(finder.board(), view, SmallCamera(), pose)), 0.1);
}

TEST(AprilGridTest, OtherColumnsAreSeen) {
  AprilGrid wrong = Grid();
  wrong.rows = 5;
  wrong.columns = 4;
  AprilGridFinder finder(wrong);
  const cv::Mat picture = Picture(Before(0, 0, 0.4, 0.3));
  EXPECT_TRUE(finder.Find(picture).empty());
  const BoardAbsence absence = finder.Explain(picture);
  ASSERT_TRUE(absence.seen.has_value());
  EXPECT_EQ(*absence.seen, (BoardCounts{4, 5}));
}

TEST(AprilGridTest, APartOfALargerGridIsToldByTheTagsBesideIt) {
  AprilGrid part = Grid();
  part.rows = 3;
  AprilGridFinder finder(part), whole(Grid());
  const cv::Mat picture = Picture(Before(0, 0, 0.4, 0.3));
  const BoardView view = finder.Find(picture);
  EXPECT_EQ(view.ids.size(), 60u);
  EXPECT_EQ(view.part_of, (BoardCounts{4, 5}));
  EXPECT_FALSE(whole.Find(picture).part_of.has_value());
}

TEST(AprilGridTest, OtherIdsAndFamiliesAreToldByTheirNames) {
  AprilGrid other_ids = Grid(), other_family = Grid();
  other_ids.first_id = 200;
  other_family.family = "tag25h9";
  const cv::Mat picture = Picture(Before(0, 0, 0.4, 0.3));
  for (const AprilGrid& said : {other_ids, other_family}) {
    AprilGridFinder finder(said);
    EXPECT_TRUE(finder.Find(picture).empty());
    const BoardAbsence absence = finder.Explain(picture);
    ASSERT_TRUE(absence.others.has_value());
    EXPECT_EQ(absence.others->family, "tag36h11");
    EXPECT_EQ(absence.others->first_id, 7);
    EXPECT_EQ(absence.others->last_id, 26);
    EXPECT_THAT(FlawOfBoard(finder, {.absences = {absence, {}}}),
                HasSubstr("I see tags of tag36h11 with ids 7 to 26 in 1 of 2 pictures, you said"));
  }
}

TEST(AprilGridTest, AMirroredPictureIsToldFromOneWithoutABoard) {
  AprilGridFinder finder(Grid());
  cv::Mat picture = Picture(Before(0, 0, 0.4, 0.3));
  cv::flip(picture, picture, 1);
  EXPECT_TRUE(finder.Find(picture).empty());
  EXPECT_TRUE(finder.Explain(picture).is_mirrored);
  const cv::Mat empty(480, 640, CV_8UC1, cv::Scalar(90));
  EXPECT_TRUE(finder.Find(empty).empty());
  EXPECT_FALSE(finder.Explain(empty).is_mirrored);
  EXPECT_FALSE(finder.Explain(empty).seen.has_value());
  EXPECT_FALSE(finder.Explain(empty).others.has_value());
}

// From rendered pictures to the camera, most of them showing part of the grid only.
TEST(AprilGridTest, CalibratesFromPartsOfTheGrid) {
  auto rng = testing::TestRng();
  AprilGridFinder finder(Grid());
  const auto planted = testing::PlantBoardViews(
      finder.board(), SmallCamera(),
      {.num_views = 10, .largest_tilt_rad = 0.7, .may_leave_picture = true}, &rng);
  std::vector<BoardView> views;
  for (const Eigen::Isometry3d& pose : planted.cam_from_board)
    if (BoardView view = finder.Find(Picture(pose)); !view.empty()) views.push_back(view);
  ASSERT_GE(views.size(), 8u);
  const CalibrationResult result =
      CalibrateCamera(finder.board(), views, {800, 600}, {.lens = LensModel::kK1K2});
  ASSERT_TRUE(result.IsUsable()) << result.BriefReport();
  EXPECT_NEAR(result.camera.fx_px, 700.0, 1.5);
  EXPECT_NEAR(result.camera.cx_px, 401.0, 1.5);
  EXPECT_LT(result.rms_px, 0.1);
}

TEST(AprilGridTest, ImpossibleGridsAreRefused) {
  const auto flaw = [](auto change) {
    AprilGrid grid = Grid();
    change(&grid);
    return grid.Validate();
  };
  EXPECT_EQ(Grid().Validate(), "");
  EXPECT_THAT(flaw([](AprilGrid* g) { g->rows = 0; }), HasSubstr("0 x 5 tags"));
  EXPECT_THAT(flaw([](AprilGrid* g) { g->tag_size_m = 0; }), HasSubstr("tag size"));
  EXPECT_THAT(flaw([](AprilGrid* g) { g->spacing = 0.1; }), HasSubstr("at least 0.125"));
  EXPECT_THAT(flaw([](AprilGrid* g) { g->first_id = 580; }), HasSubstr("ids below 587"));
  AprilGrid grid = Grid();
  grid.rows = 0;
  EXPECT_THROW(AprilGridFinder finder(grid), InputError);
}

constexpr const char* kTarget = R"(target_type: 'aprilgrid' #gridtype
tagCols: 6
tagRows: 5
tagSize: 0.088           #size of apriltag, edge to edge [m]
tagSpacing: 0.3          #ratio of space between tags to tagSize
)";

std::string Complaint(const std::string& from, const std::string& to) {
  std::string text = kTarget;
  text.replace(text.find(from), from.size(), to);
  try {
    ReadAprilGridYaml(WriteScratch("grid.yaml", text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "(read without complaint)";
}

TEST(AprilGridYaml, KalibrsTargetIsRead) {
  const AprilGrid grid = ReadAprilGridYaml(WriteScratch("grid.yaml", kTarget));
  EXPECT_EQ(grid.rows, 5);
  EXPECT_EQ(grid.columns, 6);
  EXPECT_EQ(grid.tag_size_m, 0.088);
  EXPECT_EQ(grid.spacing, 0.3);
  EXPECT_EQ(grid.first_id, 0);
  EXPECT_EQ(grid.family, "tag36h11b2");
}

TEST(AprilGridYaml, WrittenIsRead) {
  AprilGrid grid = Grid();
  grid.family = "tag25h9";
  WriteAprilGridYaml(grid, testing::ScratchDir() / "out.yaml");
  const AprilGrid read = ReadAprilGridYaml(testing::ScratchDir() / "out.yaml");
  EXPECT_EQ(read.rows, 4);
  EXPECT_EQ(read.columns, 5);
  EXPECT_EQ(read.tag_size_m, 0.04);
  EXPECT_EQ(read.first_id, 7);
  EXPECT_EQ(read.family, "tag25h9");
}

TEST(AprilGridYaml, FlawsAreRefusedWithTheirLine) {
  EXPECT_THAT(Complaint("aprilgrid", "checkerboard"), HasSubstr("grid.yaml:1: target_type: found"));
  EXPECT_THAT(Complaint("tagCols", "cols"), HasSubstr("found no tagCols"));
  EXPECT_THAT(Complaint("0.088", "88mm"), HasSubstr("grid.yaml:4: tagSize: found \"88mm\""));
  EXPECT_THAT(Complaint("0.088", "88"), HasSubstr("found the tag size 88 m"));
  EXPECT_THAT(Complaint("0.3 ", "0.3\ntagFamily: tag36h12"), HasSubstr("grid.yaml:6: tagFamily"));
  EXPECT_THAT(Complaint("tagRows: 5", "tagRows: [5"), HasSubstr("found no YAML"));
  EXPECT_THAT(Complaint(kTarget, "some words\n"), HasSubstr("found no target_type"));
}

}  // namespace
}  // namespace poselift
