// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: random zooms and pans. Checked: what is under the cursor stays there, and ways there
// and back are inverse.
#include "ui/label/view_transform.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;

double Between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1'000'001) / 1e6;
}

Eigen::Vector2d Point(double low, double high) { return {Between(low, high), Between(low, high)}; }

TEST(ViewTransform, ThePointUnderTheCursorStaysWhereverItIsZoomed) {
  EXPECT_TRUE(rc::check([] {
    ViewTransform view;
    for (int i = *rc::gen::inRange(1, 40); i > 0; --i) {
      const Eigen::Vector2d cursor = Point(-200.0, 2000.0);
      const Eigen::Vector2d x_px = view.ToPicture(cursor);
      view.ZoomAt(cursor, Between(0.05, 20.0));
      // Far away, what a double can tell of a point is less.
      const double tolerance = 1e-9 * (1.0 + x_px.norm());
      RC_ASSERT(MatrixNear(view.ToPicture(cursor), x_px, tolerance));
      view.Pan(Point(-300.0, 300.0));
      if (*rc::gen::inRange(0, 4) == 0) view.Mirror(1280.0);
    }
    RC_ASSERT(view.scale() >= ViewTransform::kLeastScale);
    RC_ASSERT(view.scale() <= ViewTransform::kLargestScale);
  }));
}

TEST(ViewTransform, ToWidgetAndToPictureAreInverse) {
  EXPECT_TRUE(rc::check([] {
    ViewTransform view;
    view.ZoomAt(Point(0.0, 500.0), Between(0.1, 10.0));
    view.Pan(Point(-500.0, 500.0));
    if (*rc::gen::arbitrary<bool>()) view.Mirror(900.0);
    const Eigen::Vector2d x_px = Point(-100.0, 8000.0);
    RC_ASSERT(MatrixNear(view.ToPicture(view.ToWidget(x_px)), x_px, 1e-8));
  }));
}

TEST(ViewTransform, MirroredIsTheSameFromTheOtherSide) {
  ViewTransform view;
  view.Fit({4000, 2000}, {800, 600});
  const Eigen::Vector2d before = view.ToWidget({100, 50});
  view.Mirror(800);
  EXPECT_TRUE(
      MatrixNear(view.ToWidget({100, 50}), Eigen::Vector2d(800 - before.x(), before.y()), 1e-9));
  view.FitBox({100, 50}, {300, 150}, {800, 600});
  EXPECT_TRUE(view.is_mirrored());
  EXPECT_TRUE(MatrixNear(view.ToWidget({199.5, 99.5}), Eigen::Vector2d(400, 300), 2.1));
}

TEST(ViewTransform, FitShowsAllOfThePictureInTheMiddle) {
  ViewTransform view;
  view.Fit({4000, 2000}, {800, 600});
  EXPECT_DOUBLE_EQ(view.scale(), 0.2);
  EXPECT_TRUE(MatrixNear(view.ToWidget({-0.5, -0.5}), Eigen::Vector2d(0, 100), 1e-9));
  EXPECT_TRUE(MatrixNear(view.ToWidget({3999.5, 1999.5}), Eigen::Vector2d(800, 500), 1e-9));
  view.Fit({0, 0}, {800, 600});  // no picture yet
  EXPECT_DOUBLE_EQ(view.scale(), 0.2);
}

TEST(ViewTransform, APixelsCentreIsHalfAPixelFromItsEdge) {
  const ViewTransform view;
  EXPECT_TRUE(MatrixNear(view.ToWidget({0, 0}), Eigen::Vector2d(0.5, 0.5), 0.0));
}

}  // namespace
}  // namespace poselift
