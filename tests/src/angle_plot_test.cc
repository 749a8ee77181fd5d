// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The text of real plots: what is drawn is counted, and found where it belongs.
#include "src/draw/angle_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <stdexcept>

#include "src/input_error.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

AngleCurve Curve(const std::string& name, const Eigen::VectorXd& values_deg) {
  return {.name = name,
          .times_s = Eigen::VectorXd::LinSpaced(values_deg.size(), 0.0, 1.0),
          .values_deg = values_deg,
          .sigmas_deg = {}};
}

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// The points of the widest stroke that is a curve.
std::vector<Eigen::Vector2d> PointsOfCurve(const std::string& svg) {
  const std::regex curve(
      "<path d=\"([^\"]*)\" fill=\"none\" stroke=\"#[0-9a-f]*\" stroke-width=\"1.8\"");
  std::smatch found;
  EXPECT_TRUE(std::regex_search(svg, found, curve));
  const std::string path = found[1];
  const std::regex point("[ML]([-0-9.]+) ([-0-9.]+)");
  std::vector<Eigen::Vector2d> points;
  for (auto it = std::sregex_iterator(path.begin(), path.end(), point);
       it != std::sregex_iterator(); ++it)
    points.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  return points;
}

TEST(AnglePlot, ValuesLieWhereTheAxesSay) {
  AnglePlot plot;
  plot.curves = {Curve("a", Eigen::Vector3d(-10.0, 30.0, 50.0))};
  const std::vector<Eigen::Vector2d> points = PointsOfCurve(AnglePlotSvg(plot));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_NEAR(points[1].x(), 0.5 * (points[0].x() + points[2].x()), 0.02);
  EXPECT_GT(points[0].y(), points[1].y());  // up is less
  EXPECT_NEAR((points[0].y() - points[1].y()) / (points[1].y() - points[2].y()), 2.0, 1e-3);
}

TEST(AnglePlot, AxesHaveUnitsRoundTicksAndALegend) {
  AnglePlot plot;
  plot.title = "Knees";
  plot.curves = {Curve("left_knee.flexion", Eigen::Vector3d(0.0, 61.0, 9.0)),
                 Curve("right_knee.flexion", Eigen::Vector3d(5.0, 10.0, 60.0))};
  plot.curves[1].color_index = 1;
  plot.curves[1].dash_index = 2;
  const std::string svg = AnglePlotSvg(plot);
  for (const char* text : {">time (s)<", ">angle (degrees)<", ">Knees<", ">left_knee.flexion<",
                           ">right_knee.flexion<", ">20<", ">40<", ">0.2<", ">1.0<"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_EQ(Count(svg, "#0072b2"), 2);  // curve and legend
  EXPECT_EQ(Count(svg, "#d55e00"), 2);
  EXPECT_EQ(Count(svg, "stroke-dasharray=\"2 3\""), 2);
}

TEST(AnglePlot, NaNLeavesAGapAndALoneValueIsADot) {
  AnglePlot plot;
  Eigen::VectorXd values(8);
  values << 1, 2, kNaN, 4, kNaN, kNaN, 7, 8;
  plot.curves = {Curve("a", values)};
  const std::string svg = AnglePlotSvg(plot);
  EXPECT_EQ(PointsOfCurve(svg).size(), 5u);
  const std::string path = svg.substr(svg.find("<path d=\"M", svg.find("time (s)")));
  EXPECT_EQ(Count(path.substr(0, path.find("stroke-width")), "M"), 3);
  EXPECT_EQ(Count(svg, "h0\""), 0);
  EXPECT_EQ(Count(svg, "h0M"), 1);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(AnglePlot, TheBandIsOneSigmaOnEitherSideAndTheLegendSaysSo) {
  AnglePlot plot;
  plot.curves = {Curve("a", Eigen::Vector2d(0.0, 10.0))};
  EXPECT_EQ(Count(AnglePlotSvg(plot), "fill-opacity"), 0);
  EXPECT_THAT(AnglePlotSvg(plot), Not(HasSubstr("deviation")));
  plot.curves[0].sigmas_deg = Eigen::Vector2d(5.0, 5.0);
  const std::string svg = AnglePlotSvg(plot);
  EXPECT_EQ(Count(svg, "fill-opacity"), 2);  // the band, and in the legend
  EXPECT_THAT(svg, HasSubstr(">± 1 standard deviation<"));
  const std::vector<Eigen::Vector2d> curve = PointsOfCurve(svg);
  const double px_per_deg = (curve[0].y() - curve[1].y()) / 10.0;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(svg, found, std::regex("<path d=\"M[0-9.]+ ([0-9.]+)L")));
  EXPECT_NEAR((curve[0].y() - std::stod(found[1])) / px_per_deg, 5.0, 0.01);
}

TEST(AnglePlot, SpansAreShadedAndStripsNamed) {
  AnglePlot plot;
  plot.curves = {Curve("a", Eigen::Vector2d(0.0, 10.0))};
  const int plain = Count(AnglePlotSvg(plot), "<rect");
  plot.shaded = {{0.2, 0.4}, {0.7, 9.0}, {5.0, 6.0}};  // the last lies outside
  plot.shaded_name = "filled";
  plot.strips = {{"left foot", {{0.1, 0.3}}}, {"right foot", {}}};
  const std::string svg = AnglePlotSvg(plot);
  EXPECT_EQ(Count(svg, "<rect"), plain + 2 + 1 + 1);  // spans, legend, strip
  for (const char* text : {">filled<", ">left foot<", ">right foot<"})
    EXPECT_THAT(svg, HasSubstr(text));
}

TEST(AnglePlot, TextIsEscaped) {
  AnglePlot plot;
  plot.title = "<script>&\"\x01\xff";
  plot.curves = {Curve("a<b", Eigen::Vector2d(0.0, 10.0))};
  const std::string svg = AnglePlotSvg(plot);
  EXPECT_THAT(svg, HasSubstr("&lt;script&gt;&amp;&quot;?\xef\xbf\xbd<"));
  EXPECT_THAT(svg, HasSubstr(">a&lt;b<"));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
}

TEST(AnglePlot, FlatAndLoneCurvesHaveAxesToo) {
  for (const Eigen::VectorXd& values : {Eigen::VectorXd(Eigen::VectorXd::Constant(1, 7.0)),
                                        Eigen::VectorXd(Eigen::VectorXd::Constant(50, -1e6))}) {
    AnglePlot plot;
    plot.curves = {Curve("a", values)};
    const std::string svg = AnglePlotSvg(plot);
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
    EXPECT_LT(svg.size(), 20000u);
  }
}

TEST(AnglePlot, NothingToDrawIsRefused) {
  AnglePlot plot;
  EXPECT_THROW(AnglePlotSvg(plot), InputError);
  plot.curves = {Curve("a", Eigen::Vector2d(kNaN, kNaN))};
  EXPECT_THROW(AnglePlotSvg(plot), InputError);
  plot.curves[0].times_s.resize(1);
  EXPECT_THROW(AnglePlotSvg(plot), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
