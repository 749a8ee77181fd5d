// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The text of the pictures, read back with regular expressions.
#include "src/draw/bar_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <set>
#include <stdexcept>

namespace poselift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Heights of the bars, left to right; they are the rectangles with a y and a fill
// that the legend's squares are too, so those of 11 x 11 are left out.
std::vector<double> BarHeights(const std::string& svg) {
  const std::regex bar(
      "<rect x=\"[0-9.]+\" y=\"[0-9.]+\" width=\"([0-9.]+)\" height=\"([0-9.]+)\"");
  std::vector<double> heights;
  for (std::sregex_iterator it(svg.begin(), svg.end(), bar), end; it != end; ++it)
    if ((*it)[1] != "11") heights.push_back(std::stod((*it)[2]));
  return heights;
}

BarChart TwoByTwo() {
  BarChart chart{"errors & such", "mm", {"walking", "running"}, {"a<b", "c"}, {}, 0.0};
  chart.values.resize(2, 2);
  chart.values << 10.0, 20.0, 30.0, 40.0;
  return chart;
}

TEST(BarChart, HeightsGoWithTheValues) {
  const auto heights = BarHeights(BarChartSvg(TwoByTwo()));
  ASSERT_EQ(heights.size(), 4u);
  EXPECT_NEAR(heights[1] / heights[0], 3.0, 0.01);  // a group's series side by side
  EXPECT_NEAR(heights[2] / heights[0], 2.0, 0.01);
  EXPECT_NEAR(heights[3] / heights[0], 4.0, 0.01);
}

TEST(BarChart, NamesEverythingAndEscapesIt) {
  const std::string svg = BarChartSvg(TwoByTwo());
  for (const char* text : {"errors &amp; such", "a&lt;b", ">c<", ">walking<", ">running<", ">mm<"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("a<b")));
}

TEST(BarChart, CutsBarsOffAndSaysTheirValue) {
  BarChart chart = TwoByTwo();
  chart.cut_off = 20.0;
  const std::string svg = BarChartSvg(chart);
  const auto heights = BarHeights(svg);
  ASSERT_EQ(heights.size(), 4u);
  EXPECT_EQ(heights[1], heights[3]);
  EXPECT_EQ(heights[1], heights[2]);
  EXPECT_NEAR(heights[1] / heights[0], 2.0, 0.01);
  EXPECT_THAT(svg, HasSubstr(">30<"));
  EXPECT_THAT(svg, HasSubstr(">40<"));
}

TEST(BarChart, LongLegendsGoOnInAnotherRow) {
  BarChart chart{"errors", "mm", {"walking"}, {}, {}, 0.0};
  chart.series.assign(9, "a method with a long name");
  chart.values.setOnes(9, 1);
  const std::string svg = BarChartSvg(chart);
  std::set<std::string> rows;
  const std::regex sample("y=\"([0-9.]+)\" width=\"11\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), sample), end; it != end; ++it)
    rows.insert((*it)[1]);
  EXPECT_EQ(rows.size(), 3u);
  EXPECT_THAT(svg, HasSubstr("height=\"380\""));  // two rows more than one legend's
}

TEST(BarChart, LeavesOutWhatIsNoValue) {
  BarChart chart = TwoByTwo();
  chart.values(0, 0) = std::numeric_limits<double>::quiet_NaN();
  chart.values(1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(BarHeights(BarChartSvg(chart)).size(), 2u);
  chart.values.setZero();
  EXPECT_EQ(BarHeights(BarChartSvg(chart)), std::vector<double>(4, 0.0));
}

TEST(BarChart, RefusesSizesThatDoNotFit) {
  BarChart chart = TwoByTwo();
  chart.series.pop_back();
  EXPECT_THROW(BarChartSvg(chart), std::invalid_argument);
  EXPECT_THROW(BarChartSvg({}), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
