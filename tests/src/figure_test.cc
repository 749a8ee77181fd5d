// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real drawing of made-up joints on a blank canvas; colours are sampled where
// the geometry says what must lie there. Sides, order by depth, missing joints,
// and coordinates beyond anything an integer holds.
#include "src/draw/figure.h"

#include <limits>

#include "src/draw/style.h"
#include "tests/support/pictures.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::At;
using testing::IsLeftBlue;
using testing::IsRightOrange;
using testing::SamePicture;
using namespace joint;  // NOLINT(google-build-using-namespace)

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

cv::Mat Blank() { return cv::Mat(200, 200, CV_8UC3, palette::kPaper); }

Pose3 NoJoints() { return Pose3::Constant(3, kNumJoints, kNaN); }

// The shins cross in the middle of the canvas.
Pose3 CrossedShins(double left_depth_px, double right_depth_px) {
  Pose3 joints = NoJoints();
  joints.col(kLeftKnee) << 40, 40, left_depth_px;
  joints.col(kLeftAnkle) << 160, 160, left_depth_px;
  joints.col(kRightKnee) << 160, 40, right_depth_px;
  joints.col(kRightAnkle) << 40, 160, right_depth_px;
  return joints;
}

TEST(Figure, NearerBoneLiesOverFartherOne) {
  cv::Mat left_near = Blank(), right_near = Blank();
  DrawFigure(&left_near, CrossedShins(-50, 50), {6.0});
  DrawFigure(&right_near, CrossedShins(50, -50), {6.0});
  EXPECT_TRUE(IsLeftBlue(At(left_near, 100, 100)));
  EXPECT_FALSE(IsLeftBlue(At(right_near, 100, 100)));
}

TEST(Figure, NearerBoneIsThicker) {
  const auto width_at_quarter = [](const Pose3& joints) {
    cv::Mat canvas = Blank();
    DrawFigure(&canvas, joints, {6.0});
    int width = 0;
    for (int x = 40; x < 100; ++x) width += IsLeftBlue(At(canvas, x, 70));
    return width;
  };
  EXPECT_GT(width_at_quarter(CrossedShins(-50, 50)), width_at_quarter(CrossedShins(50, -50)));
}

TEST(Figure, SidesDifferInColourAndInForm) {
  cv::Mat canvas = Blank();
  DrawFigure(&canvas, CrossedShins(0, 0), {6.0});
  EXPECT_TRUE(IsLeftBlue(At(canvas, 40, 40)));
  EXPECT_TRUE(IsRightOrange(At(canvas, 160, 40)));
  int gaps_left = 0, gaps_right = 0;
  for (int i = 50; i < 90; ++i) {  // along the bones, away from their crossing
    gaps_left += !IsLeftBlue(At(canvas, i, i));
    gaps_right += !IsRightOrange(At(canvas, 200 - i, i));
  }
  EXPECT_EQ(gaps_left, 0);
  EXPECT_GT(gaps_right, 8);
}

TEST(Figure, MirroredPoseSwapsTheSides) {
  const Pose3 joints = CrossedShins(-50, 50);
  Pose3 mirrored = joints;
  for (int j = 0; j < kNumJoints; ++j) mirrored.col(j) = joints.col(Joints()[j].mirror);
  mirrored.row(0) = 200.0 - mirrored.row(0).array();
  cv::Mat canvas = Blank(), mirror_canvas = Blank();
  DrawFigure(&canvas, joints, {6.0});
  DrawFigure(&mirror_canvas, mirrored, {6.0});
  EXPECT_TRUE(IsLeftBlue(At(canvas, 40, 40)));
  EXPECT_TRUE(IsRightOrange(At(mirror_canvas, 160, 40)));
  EXPECT_TRUE(IsRightOrange(At(canvas, 160, 40)));
  EXPECT_TRUE(IsLeftBlue(At(mirror_canvas, 40, 40)));
}

TEST(Figure, MissingJointsDrawNothing) {
  cv::Mat canvas = Blank();
  DrawFigure(&canvas, NoJoints(), {6.0, 10.0});
  EXPECT_TRUE(SamePicture(canvas, Blank()));

  Pose3 joints = CrossedShins(0, 0);
  joints(2, kLeftAnkle) = kInfinity;
  DrawFigure(&canvas, joints, {6.0, 10.0});
  EXPECT_TRUE(IsLeftBlue(At(canvas, 40, 40)));
  EXPECT_EQ(At(canvas, 160, 160), At(Blank(), 160, 160));
  EXPECT_EQ(At(canvas, 70, 70), At(Blank(), 70, 70));
}

TEST(Figure, BoneToAFarJointReachesTheBorder) {
  for (const double far : {1e4, 1e9, 1e12, 1e99}) {
    Pose3 joints = NoJoints();
    joints.col(kLeftKnee) << 100, 100, 0;
    joints.col(kLeftAnkle) << far, 100, 0;
    cv::Mat canvas = Blank();
    DrawFigure(&canvas, joints, {6.0, 10.0});
    EXPECT_TRUE(IsLeftBlue(At(canvas, 199, 100))) << far;
    EXPECT_EQ(At(canvas, 50, 100), At(Blank(), 50, 100)) << far;
  }
}

TEST(Figure, WildCoordinatesAreHarmless) {
  auto rng = testing::TestRng();
  const double values[] = {0, 1, 100, -1e3, 1e6, 3e9, -1e15, 1e99, -1e150, 1e308, kInfinity, kNaN};
  std::uniform_int_distribution<int> pick(0, static_cast<int>(std::size(values)) - 1);
  for (int trial = 0; trial < 300; ++trial) {
    Pose3 joints(3, kNumJoints);
    for (double& value : joints.reshaped()) value = values[pick(rng)];
    cv::Mat canvas = Blank();
    EXPECT_NO_THROW(DrawFigure(&canvas, joints, {6.0, 10.0}));
    EXPECT_NO_THROW(DrawBones(&canvas, joints, palette::kGhost, 2.0));
  }
}

TEST(Figure, PoseInOnePointStaysThere) {
  cv::Mat canvas = Blank();
  DrawFigure(&canvas, Pose3::Constant(3, kNumJoints, 100.0), {6.0, 10.0});
  EXPECT_NE(At(canvas, 100, 100), At(Blank(), 100, 100));
  canvas(cv::Rect(60, 60, 80, 80)) = palette::kPaper;
  EXPECT_TRUE(SamePicture(canvas, Blank()));
}

TEST(Figure, SideOfALandmarkIsReadFromItsName) {
  EXPECT_EQ(SideOf("left_ear"), Side::kLeft);
  EXPECT_EQ(SideOf("right_big_toe"), Side::kRight);
  EXPECT_EQ(SideOf("nose"), Side::kCentre);
  EXPECT_EQ(SideOf("leftover"), Side::kCentre);
  for (int j = 0; j < kNumJoints; ++j)
    EXPECT_EQ(SideOf(j) == Side::kCentre, Joints()[j].mirror == j) << Joints()[j].name;
}

}  // namespace
}  // namespace poselift
