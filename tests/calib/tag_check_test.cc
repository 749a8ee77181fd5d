// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A tag is drawn at a known place and smeared by known lengths: the width of its edges is that
// of the smear, across it alone; a mirrored picture is told by its tags.
#include "calib/tag_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "calib/edge_width.h"
#include "calib/tag_family.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr int kCell_px = 12;
constexpr int kLeft_px = 60;
constexpr int kTop_px = 40;

// Upright, black at 40 and white at 220.
cv::Mat TagPicture() {
  const cv::Mat cells = TagFamily("tag36h11").Image(5);
  cv::Mat print, picture(240, 320, CV_8UC1, cv::Scalar(220));
  cv::resize(cells, print, {}, kCell_px, kCell_px, cv::INTER_NEAREST);
  print.convertTo(print, -1, 180.0 / 255.0, 40.0);
  print.copyTo(picture(cv::Rect(kLeft_px, kTop_px, print.cols, print.rows)));
  return picture;
}

TagDetection TagOfPicture() {
  const TagFamily family("tag36h11");
  const double border = 0.5 * (family.cells() - family.cells_of_size());
  const double left = kLeft_px - 0.5 + border * kCell_px;
  const double top = kTop_px - 0.5 + border * kCell_px;
  const double size = family.cells_of_size() * kCell_px;
  TagDetection tag;
  tag.corners_px << left, left + size, left + size, left, top, top, top + size, top + size;
  return tag;
}

std::array<double, 2> Widths_px(const cv::Mat& picture) {
  return EdgeWidths_px(picture, TagOfPicture(), TagFamily("tag36h11").cells_of_size());
}

TEST(EdgeWidth, IsBelowAPixelOfASharpEdge) {
  const auto [across_rows_px, across_columns_px] = Widths_px(TagPicture());
  EXPECT_NEAR(across_rows_px, 0.8, 0.05);  // what is left is the interpolation between pixels
  EXPECT_NEAR(across_columns_px, 0.8, 0.05);
}

TEST(EdgeWidth, IsThatOfTheMotionAcrossItAlone) {
  for (const int length_px : {3, 5, 9}) {
    cv::Mat sideways, downwards;
    cv::blur(TagPicture(), sideways, {length_px, 1});
    cv::blur(TagPicture(), downwards, {1, length_px});
    EXPECT_NEAR(Widths_px(sideways)[0], 0.8, 0.05);
    EXPECT_NEAR(Widths_px(sideways)[1], 0.8 * length_px, 0.3) << length_px;
    EXPECT_NEAR(Widths_px(downwards)[0], 0.8 * length_px, 0.3) << length_px;
    EXPECT_NEAR(Widths_px(downwards)[1], 0.8, 0.05);
  }
}

TEST(EdgeWidth, IsThatOfTheFocusBothWays) {
  cv::Mat soft;
  cv::GaussianBlur(TagPicture(), soft, {}, 1.5);
  for (const double width_px : Widths_px(soft))
    EXPECT_NEAR(width_px, 2.0 * 1.2816 * std::hypot(1.5, 0.29), 0.15);  // of a Gaussian, twice 1.28
}

TEST(EdgeWidth, IsNotThereWithoutATag) {
  EXPECT_TRUE(std::isnan(Widths_px(cv::Mat(240, 320, CV_8UC1, cv::Scalar(90)))[0]));
  EXPECT_TRUE(std::isnan(Widths_px(TagPicture()(cv::Rect(0, 0, 100, 100)))[0]));
  TagDetection small = TagOfPicture();
  small.corners_px *= 0.1;
  EXPECT_TRUE(std::isnan(EdgeWidths_px(TagPicture(), small, 8)[0]));
}

TEST(TagCheck, TellsAMirroredPicture) {
  const cv::Mat picture = TagPicture();
  cv::Mat mirrored;
  cv::flip(picture, mirrored, 1);
  const TagFacts facts = CheckTags({picture, picture}, "tag36h11");
  EXPECT_EQ(facts.num_found, 2);
  EXPECT_EQ(facts.num_found_mirrored, 0);
  EXPECT_NEAR(facts.sharper_edge_px, 0.8, 0.15);
  const TagFacts of_mirrored = CheckTags({mirrored}, "tag36h11");
  EXPECT_EQ(of_mirrored.num_found, 0);
  EXPECT_EQ(of_mirrored.num_found_mirrored, 1);
}

TEST(TagCheck, MeasuresMotion) {
  cv::Mat smeared;
  cv::blur(TagPicture(), smeared, {5, 1});
  const TagFacts facts = CheckTags({smeared}, "tag36h11");
  EXPECT_EQ(facts.num_found, 1);
  EXPECT_NEAR(facts.wider_edge_px, 4.0, 0.5);
  EXPECT_LT(facts.sharper_edge_px, 1.5);
}

TEST(TagCheck, FindsNothingInNothing) {
  const TagFacts facts = CheckTags({cv::Mat(240, 320, CV_8UC1, cv::Scalar(90))}, "tag36h11");
  EXPECT_EQ(facts.num_found + facts.num_found_mirrored, 0);
  EXPECT_EQ(CheckTags({}, "tag36h11").num_found, 0);
  EXPECT_THROW(CheckTags({}, "tag99"), InputError);
}

}  // namespace
}  // namespace poselift
