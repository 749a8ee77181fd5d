// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Faked: views of a board that moves as planted, before pictures of known sharpness. Checked:
// moving and like frames are passed over, the better of like ones stays.
#include "calib/view_chooser.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace poselift {
namespace {

constexpr int kWidth = 640, kHeight = 480;  // a diagonal of 800 px

BoardView At(double x_px, double y_px) {
  BoardView view;
  view.corners_px.resize(2, 9);
  for (int i = 0; i < 9; ++i) {
    view.ids.push_back(i);
    view.corners_px.col(i) << x_px + 30.0 * (i % 3), y_px + 30.0 * (i / 3);
  }
  return view;
}

// Squares of 30 px, so that corners at multiples of it have edges.
cv::Mat Squares(double blur_px) {
  cv::Mat grey(kHeight, kWidth, CV_8UC1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) grey.at<uchar>(y, x) = (x / 30 + y / 30) % 2 == 0 ? 20 : 230;
  if (blur_px > 0) cv::GaussianBlur(grey, grey, {}, blur_px);
  return grey;
}

TEST(ViewChooserTest, TakesStillViewsThatDiffer) {
  ViewChooser chooser({kWidth, kHeight});
  const cv::Mat grey = Squares(1.0);
  EXPECT_TRUE(chooser.Offer(grey, At(60, 60), 0, 0.0));
  EXPECT_FALSE(chooser.Offer(grey, At(62, 60), 1, 0.1));   // 2 px away: the same view
  EXPECT_FALSE(chooser.Offer(grey, At(180, 60), 2, 0.2));  // 1180 px/s: blurred
  EXPECT_TRUE(chooser.Offer(grey, At(180, 60), 3, 0.3));   // stands still
  EXPECT_TRUE(
      chooser.Offer(grey, At(300, 300), 4, 9.0));  // long after: what was before is no guide
  EXPECT_FALSE(chooser.Offer(grey, {}, 5, 9.1));
  ASSERT_EQ(chooser.views().size(), 3u);
  EXPECT_EQ(chooser.views()[1].frame, 3);
}

TEST(ViewChooserTest, TheSharperOfLikeFramesStays) {
  ViewChooser chooser({kWidth, kHeight});
  EXPECT_TRUE(chooser.Offer(Squares(3.0), At(60, 60), 0, 0.0));
  EXPECT_TRUE(chooser.Offer(Squares(1.0), At(60, 60), 1, 0.1));
  EXPECT_FALSE(chooser.Offer(Squares(2.0), At(60, 60), 2, 0.2));
  ASSERT_EQ(chooser.views().size(), 1u);
  EXPECT_EQ(chooser.views()[0].frame, 1);
}

TEST(ViewChooserTest, BlurredViewsAreLeftOutAtTheEnd) {
  ViewChooser chooser({kWidth, kHeight});
  chooser.Offer(Squares(1.0), At(60, 60), 0, 0.0);
  chooser.Offer(Squares(1.0), At(300, 60), 1, 5.0);
  chooser.Offer(Squares(4.0), At(60, 300), 2, 10.0);
  EXPECT_EQ(chooser.views().size(), 3u);
  const auto sharp = chooser.SharpViews();
  ASSERT_EQ(sharp.size(), 2u);
  EXPECT_EQ(sharp[1].frame, 1);
}

TEST(ViewChooserTest, SharpnessIsThatOfABlurredStep) {
  for (const double blur_px : {1.5, 2.5})
    EXPECT_NEAR(EdgeSharpness(Squares(blur_px), At(60, 60)), 0.4 / blur_px, 0.08 / blur_px);
  EXPECT_EQ(EdgeSharpness(cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(7)), At(60, 60)), 0.0);
}

TEST(ViewChooserTest, NoMoreViewsThanAskedForAndNoOptionsOutOfRange) {
  ViewChooser chooser({kWidth, kHeight}, {.most_views = 2});
  for (int i = 0; i < 4; ++i) chooser.Offer(Squares(1.0), At(30.0 + 120 * i, 60), i, 5.0 * i);
  EXPECT_EQ(chooser.views().size(), 2u);
  EXPECT_THROW(ViewChooser({kWidth, kHeight}, {.least_difference = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
