// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real pictures of made-up labels; colours are sampled around the places the
// labels name. Letters are not compared: fonts may vary.
#include "src/draw/overlay.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "src/draw/style.h"
#include "tests/support/pictures.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Eigen::Vector2d;
using testing::IsLeftBlue;
using testing::SamePicture;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

cv::Mat GreyPhoto(int width = 640, int height = 480) {
  return cv::Mat(height, width, CV_8UC3, cv::Scalar(120, 120, 120));
}
cv::Vec3b At(const cv::Mat& picture, const Vector2d& x_px) {
  return testing::At(picture, x_px.x(), x_px.y());
}
bool IsErrorRed(const cv::Vec3b& bgr) { return bgr[2] > bgr[1] + 80 && bgr[0] > bgr[1] + 40; }

OverlayLabel Label(const std::string& name, double x, double y,
                   LabelState state = LabelState::kVisible) {
  return {name, {x, y}, state, std::nullopt};
}

// Two labels far apart set the size of the person and with it of the marks.
OverlayInput WithLabel(const OverlayLabel& label) {
  OverlayInput input;
  input.people = {{}};
  input.people[0].labels = {Label("pelvis", 300, 20), Label("thorax", 300, 440), label};
  return input;
}

// The part of all directions from center in which a blue pixel is near.
double BlueTurn(const cv::Mat& canvas, const Vector2d& center, double reach_px) {
  int blue = 0;
  for (int degree = 0; degree < 360; ++degree) {
    const Vector2d along(std::cos(degree * M_PI / 180), std::sin(degree * M_PI / 180));
    bool found = false;
    for (int half_px = 4; half_px < 2 * reach_px; ++half_px)
      found = found || IsLeftBlue(At(canvas, center + 0.5 * half_px * along));
    blue += found;
  }
  return blue / 360.0;
}

TEST(Overlay, VisibleLabelIsAClosedRingAroundItsPixel) {
  const cv::Mat canvas = DrawOverlay(GreyPhoto(), WithLabel(Label("left_knee", 421, 203)));
  EXPECT_GT(BlueTurn(canvas, {421, 203}, 12.0), 0.97);
  EXPECT_FALSE(IsLeftBlue(At(canvas, {421, 203})));
}

TEST(Overlay, OccludedLabelIsABrokenRing) {
  const cv::Mat canvas =
      DrawOverlay(GreyPhoto(), WithLabel(Label("left_knee", 421, 203, LabelState::kOccluded)));
  const double turn = BlueTurn(canvas, {421, 203}, 12.0);
  EXPECT_GT(turn, 0.4);
  EXPECT_LT(turn, 0.85);
}

TEST(Overlay, AbsentAndUnplacedLabelsAreNotDrawn) {
  OverlayInput without = WithLabel(Label("left_knee", kNaN, 203));
  OverlayInput absent = WithLabel(Label("left_knee", 421, 203, LabelState::kAbsent));
  absent.people[0].labels[2].reprojected_px = Vector2d(100, 100);
  EXPECT_TRUE(SamePicture(DrawOverlay(GreyPhoto(), without), DrawOverlay(GreyPhoto(), absent)));
}

TEST(Overlay, ResidualLineIsRedWhenLongAndPaleWhenShort) {
  OverlayInput input = WithLabel(Label("left_knee", 421, 203));
  input.people[0].labels[2].reprojected_px = Vector2d(481, 203);
  EXPECT_TRUE(IsErrorRed(At(DrawOverlay(GreyPhoto(), input), {451, 203})));
  input.people[0].labels[2].reprojected_px = Vector2d(424, 203);
  EXPECT_FALSE(IsErrorRed(At(DrawOverlay(GreyPhoto(), input), {423, 203})));
}

TEST(Overlay, OnlyALargeResidualGetsItsNumber) {
  const auto text_pixels = [](double residual_px) {
    OverlayInput input = WithLabel(Label("left_knee", 421, 203));
    input.people[0].labels[2].reprojected_px = Vector2d(421 - residual_px, 203);
    const cv::Mat canvas = DrawOverlay(GreyPhoto(), input);
    int bright = 0;  // to the right of the ring: the number and nothing else
    for (int y = 195; y < 212; ++y)
      for (int x = 436; x < 500; ++x) bright += At(canvas, Vector2d(x, y))[2] > 200;
    return bright;
  };
  EXPECT_EQ(text_pixels(5.0), 0);
  EXPECT_GT(text_pixels(40.0), 20);
}

TEST(Overlay, PhotoIsDimmedAndKeepsItsSize) {
  const cv::Mat canvas = DrawOverlay(GreyPhoto(333, 517), {});
  EXPECT_EQ(canvas.size(), cv::Size(333, 517));
  EXPECT_LT(At(canvas, {300, 500})[0], 120);
  EXPECT_GT(At(canvas, {300, 500})[0], 60);
}

TEST(Overlay, LargePhotoIsDrawnSmallerWithTheMarksInPlace) {
  OverlayOptions options;
  options.max_side_px = 400;
  OverlayInput input = WithLabel(Label("left_knee", 1000, 600));
  input.people[0].labels[1].x_px = {300, 1100};
  const cv::Mat canvas = DrawOverlay(GreyPhoto(1600, 1200), input, options);
  EXPECT_EQ(canvas.size(), cv::Size(400, 300));
  EXPECT_GT(BlueTurn(canvas, {1000.5 / 4 - 0.5, 600.5 / 4 - 0.5}, 9.0), 0.97);
}

TEST(Overlay, CanvasWithoutAPhotoHasTheStatedSizeOrHoldsTheLabels) {
  OverlayInput input = WithLabel(Label("left_knee", 421, 203));
  EXPECT_GE(DrawOverlay({}, input).cols, 422);
  EXPECT_GE(DrawOverlay({}, input).rows, 441);
  input.width_px = 640;
  input.height_px = 425;
  EXPECT_EQ(DrawOverlay({}, input).size(), cv::Size(640, 425));
  input.width_px = input.height_px = std::numeric_limits<int>::max();
  EXPECT_EQ(DrawOverlay({}, input).size(), cv::Size(3000, 3000));
  input.height_px = 1;
  EXPECT_EQ(DrawOverlay({}, input).size(), cv::Size(3000, 1));
  EXPECT_EQ(DrawOverlay({}, {}).size(), cv::Size(64, 64));
}

TEST(Overlay, LegendLeavesTheCornerWhereThePersonIs) {
  OverlayInput input = WithLabel(Label("left_knee", 40, 40));
  const cv::Mat canvas = DrawOverlay(GreyPhoto(), input);
  const cv::Mat background = DrawOverlay(GreyPhoto(), WithLabel(Label("left_knee", kNaN, 0)));
  EXPECT_LT(At(background, {2, 2})[0], 60);  // the legend's dark box
  EXPECT_GT(At(canvas, {2, 2})[0], 60);
}

TEST(Overlay, RmsThatIsNoNumberIsLeftOut) {
  OverlayInput input = WithLabel(Label("left_knee", 421, 203));
  const cv::Mat without = DrawOverlay(GreyPhoto(), input);
  input.people[0].reprojection_rms_px = kNaN;
  EXPECT_TRUE(SamePicture(DrawOverlay(GreyPhoto(), input), without));
  input.people[0].reprojection_rms_px = 1.7;
  EXPECT_FALSE(SamePicture(DrawOverlay(GreyPhoto(), input), without));
}

TEST(Overlay, WildNumbersAreHarmlessOnAnyCanvas) {
  auto rng = testing::TestRng();
  const double values[] = {0, 3, 200, -1e3, 1e9, 1e99, -1e200, 1e308, HUGE_VAL, kNaN};
  std::uniform_int_distribution<int> pick(0, static_cast<int>(std::size(values)) - 1);
  const auto wild = [&] { return values[pick(rng)]; };
  for (int trial = 0; trial < 100; ++trial) {
    OverlayPerson person;
    person.joints_in_px = Pose3(3, kNumJoints);
    for (double& value : person.joints_in_px.reshaped()) value = wild();
    for (int i = 0; i < 9; ++i)
      person.labels.push_back(
          {"left_knee", {wild(), wild()}, LabelState::kOccluded, Vector2d(wild(), wild())});
    person.reprojection_rms_px = wild();
    OverlayInput input;
    input.people = {person};
    EXPECT_NO_THROW(DrawOverlay(GreyPhoto(1 + trial, 1 + trial % 7), input));
    if (trial < 10) {
      EXPECT_NO_THROW(DrawOverlay({}, input));
    }
  }
}

TEST(Overlay, RefusesWhatItCannotDraw) {
  EXPECT_THROW(DrawOverlay(cv::Mat(9, 9, CV_8UC1), {}), std::invalid_argument);
  OverlayInput input;
  input.people = {{}};
  input.people[0].joints_in_px = Pose3::Zero(3, 17);
  EXPECT_THROW(DrawOverlay(GreyPhoto(), input), std::invalid_argument);
  OverlayOptions options;
  options.max_side_px = 0;
  EXPECT_THROW(DrawOverlay(GreyPhoto(), {}, options), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
