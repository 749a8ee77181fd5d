// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Exact: the formula's fixed points and its order.
#include "ui/label/picture_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

TEST(PictureLook, PlainChangesNothing) {
  EXPECT_TRUE(PictureLook().IsPlain());
  const cv::Mat1b table = PictureLook().Table();
  for (int grey = 0; grey < 256; ++grey) EXPECT_EQ(table(grey), grey);
}

TEST(PictureLook, GammaLiftsTheDarkAndKeepsBlackAndWhite) {
  const cv::Mat1b table = PictureLook{.gamma = 2.0}.Table();
  EXPECT_EQ(table(0), 0);
  EXPECT_EQ(table(255), 255);
  EXPECT_NEAR(table(64), 255.0 * std::sqrt(64.0 / 255.0), 1.0);
}

TEST(PictureLook, StaysInOrderAndWithinWhatAPixelHolds) {
  for (const PictureLook look : {PictureLook{0.5, 3.0, 0.4}, PictureLook{-0.7, 0.2, 5.0}}) {
    const cv::Mat1b table = look.Table();
    EXPECT_TRUE(std::is_sorted(table.begin(), table.end()));
  }
  EXPECT_EQ(PictureLook{.brightness = 1.0}.Table()(200), 255);
  EXPECT_EQ(PictureLook{.brightness = -1.0}.Table()(200), 0);
}

}  // namespace
}  // namespace poselift
