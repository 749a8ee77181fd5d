// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real pictures of a made-up standing person; colours are counted by panel.
#include "src/draw/pose_view.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/support/pictures.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using namespace joint;  // NOLINT(google-build-using-namespace)
using Eigen::Vector3d;
using testing::IsLeftBlue;
using testing::IsRightOrange;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kPanel_px = 300;

// Stands upright and faces the camera: the subject's left is at the right.
// The left hand is stretched towards the camera, the right one to the side.
Pose3 Standing() {
  Pose3 joints(3, kNumJoints);
  const auto set = [&](int j, double x, double y, double z) { joints.col(j) << x, y, z; };
  set(kPelvis, 0, 0, 0);
  set(kLeftHip, 0.1, 0.05, 0);
  set(kLeftKnee, 0.12, 0.48, 0);
  set(kLeftAnkle, 0.12, 0.88, 0.02);
  set(kLeftFoot, 0.13, 0.95, -0.12);
  set(kRightHip, -0.1, 0.05, 0);
  set(kRightKnee, -0.12, 0.48, 0);
  set(kRightAnkle, -0.12, 0.88, 0.02);
  set(kRightFoot, -0.13, 0.95, -0.12);
  set(kLowerBack, 0, -0.12, 0);
  set(kUpperBack, 0, -0.24, 0);
  set(kThorax, 0, -0.36, 0);
  set(kLowerNeck, 0, -0.46, 0);
  set(kUpperNeck, 0, -0.55, 0);
  set(kHeadTop, 0, -0.75, 0);
  set(kLeftShoulder, 0.18, -0.4, 0);
  set(kLeftElbow, 0.2, -0.38, -0.28);
  set(kLeftWrist, 0.2, -0.38, -0.53);
  set(kLeftHand, 0.2, -0.38, -0.62);
  set(kRightShoulder, -0.18, -0.4, 0);
  set(kRightElbow, -0.46, -0.38, 0);
  set(kRightWrist, -0.71, -0.38, 0);
  set(kRightHand, -0.8, -0.38, 0);
  return joints;
}

struct Count {
  int pixels = 0;
  double x_px = 0.0;  // middle of them
  double y_px = 0.0;
};

// Pixels of a panel (0 front, 1 side, 2 above, 3 three-quarter) of one side's colour.
Count CountColour(const cv::Mat& sheet, int panel, bool is_left) {
  const int top = sheet.rows - 2 * kPanel_px + panel / 2 * kPanel_px;
  Count count;
  for (int y = 0; y < kPanel_px; ++y) {
    for (int x = 0; x < kPanel_px; ++x) {
      const auto& bgr = sheet.at<cv::Vec3b>(top + y, panel % 2 * kPanel_px + x);
      if (!(is_left ? IsLeftBlue(bgr) : IsRightOrange(bgr))) continue;
      ++count.pixels;
      count.x_px += x;
      count.y_px += y;
    }
  }
  count.x_px /= std::max(1, count.pixels);
  count.y_px /= std::max(1, count.pixels);
  return count;
}

cv::Mat Draw(const Pose3& joints, const std::vector<Pose3>& others = {},
             const Vector3d& up = -Vector3d::UnitY()) {
  return DrawPoseView({joints, others, up, "title"}, {kPanel_px});
}

TEST(PoseView, SubjectsLeftIsAtTheRightOfTheFrontAndOfAbove) {
  const cv::Mat sheet = Draw(Standing());
  for (const int panel : {0, 2, 3}) {
    const Count left = CountColour(sheet, panel, true), right = CountColour(sheet, panel, false);
    EXPECT_GT(left.pixels, 100) << panel;
    EXPECT_GT(right.pixels, 100) << panel;
    EXPECT_GT(left.x_px, right.x_px + 20) << panel;
  }
}

TEST(PoseView, SubjectsLeftIsAtTheLeftFromBehind) {
  for (const double yaw_rad : {0.0, std::acos(-1.0)}) {
    cv::Mat sheet(2 * kPanel_px, 2 * kPanel_px, CV_8UC3, cv::Scalar::all(255));
    DrawPoseFrom({Standing()}, {.yaw_rad = yaw_rad, .pitch_rad = 0.3}, kPanel_px)
        .copyTo(sheet(cv::Rect(0, 0, kPanel_px, kPanel_px)));
    const Count left = CountColour(sheet, 0, true), right = CountColour(sheet, 0, false);
    EXPECT_GT(left.pixels, 100);
    EXPECT_GT(right.pixels, 100);
    EXPECT_EQ(left.x_px > right.x_px, yaw_rad == 0.0);
  }
}

TEST(PoseView, MirroredPoseSwapsTheColours) {
  Pose3 mirrored(3, kNumJoints);
  for (int j = 0; j < kNumJoints; ++j) mirrored.col(j) = Standing().col(Joints()[j].mirror);
  mirrored.row(0) *= -1.0;
  const cv::Mat sheet = Draw(Standing()), mirror_sheet = Draw(mirrored);
  const Count left = CountColour(sheet, 0, true), right = CountColour(mirror_sheet, 0, false);
  EXPECT_GT(left.x_px, 150.0);
  EXPECT_LT(right.x_px, 150.0);
  EXPECT_NEAR(left.x_px + right.x_px, kPanel_px, 12.0);
}

TEST(PoseView, HandTowardsTheCameraShowsInSideAndAbove) {
  Pose3 back = Standing();
  back.row(2).tail<8>() *= -1.0;  // the arms reach away from the camera instead
  // Each panel is centred anew: the right arm, which stays at its depth, is the measure.
  const auto offset = [](const Pose3& joints, int panel) -> cv::Point2d {
    const cv::Mat sheet = Draw(joints);
    const Count left = CountColour(sheet, panel, true), right = CountColour(sheet, panel, false);
    return {left.x_px - right.x_px, left.y_px - right.y_px};
  };
  EXPECT_LT(offset(Standing(), 1).x + 20, offset(back, 1).x);  // the camera is at the left
  EXPECT_GT(offset(Standing(), 2).y, offset(back, 2).y + 20);  // and at the bottom
}

TEST(PoseView, AlternativesAreThinAndGreyAndBehind) {
  Pose3 other = Standing();
  other.rightCols<8>().row(1).array() += 0.2;
  const cv::Mat with = Draw(Standing(), {other}), without = Draw(Standing());
  EXPECT_GT(cv::norm(with, without, cv::NORM_INF), 30.0);
  for (int panel = 0; panel < 4; ++panel)
    for (const bool is_left : {true, false})
      EXPECT_NEAR(CountColour(with, panel, is_left).pixels,
                  CountColour(without, panel, is_left).pixels,
                  0.15 * CountColour(without, panel, is_left).pixels);
}

TEST(PoseView, FigureStaysInsideItsPanels) {
  auto rng = testing::TestRng();
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const Pose3 joints = Pose3::NullaryExpr(3, kNumJoints, [&] { return normal(rng); });
    const cv::Mat sheet = Draw(joints, {}, {normal(rng), normal(rng), normal(rng)});
    const int header_px = sheet.rows - 2 * kPanel_px;
    for (const int x : {2, kPanel_px - 3, kPanel_px + 2, 2 * kPanel_px - 3}) {
      for (int y = header_px; y < sheet.rows; ++y) {
        const auto& bgr = sheet.at<cv::Vec3b>(y, x);
        EXPECT_LT(std::abs(bgr[0] - bgr[2]), 50) << x << " " << y;
      }
    }
  }
}

TEST(PoseView, MissingWildAndPointlikePosesAreHarmless) {
  Pose3 sparse = Pose3::Constant(3, kNumJoints, kNaN);
  EXPECT_EQ(CountColour(Draw(sparse), 0, true).pixels, 0);
  sparse.col(kLeftKnee) << 0, 0, 0;
  EXPECT_GT(CountColour(Draw(sparse), 0, true).pixels, 0);
  EXPECT_EQ(CountColour(Draw(sparse), 0, false).pixels, 0);
  for (const double value : {0.0, -7.0, 9e3, 1e5, 1e308, -HUGE_VAL})
    EXPECT_NO_THROW(Draw(Pose3::Constant(3, kNumJoints, value))) << value;
  Pose3 wide = Standing() * 5e3;
  EXPECT_NO_THROW(Draw(wide, {Standing(), sparse}, Vector3d::UnitZ()));
}

TEST(PoseView, RefusesWhatItCannotDraw) {
  EXPECT_THROW(Draw(Pose3::Zero(3, 17)), std::invalid_argument);
  EXPECT_THROW(Draw(Standing(), {Pose3::Zero(3, 2)}), std::invalid_argument);
  EXPECT_THROW(Draw(Standing(), {}, Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(Draw(Standing(), {}, {0.0, kNaN, 0.0}), std::invalid_argument);
  EXPECT_THROW(DrawPoseView({Standing()}, {10}), std::invalid_argument);
}

TEST(PoseView, TitleOfAnyBytesAndLengthIsHarmless) {
  EXPECT_NO_THROW(DrawPoseView({Standing(), {}, -Vector3d::UnitY(), std::string(100000, 'x')}));
  EXPECT_NO_THROW(DrawPoseView({Standing(), {}, -Vector3d::UnitY(), "\xff\xfe\xc3\n\t\x01 100%s"}));
}

}  // namespace
}  // namespace poselift
