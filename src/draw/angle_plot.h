// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace poselift {

// Angles over time as an SVG picture: a title, axes in seconds and degrees with
// round ticks, a grid, a legend. Nothing but text is made: no display, no font.

// One curve. Curves of the same color_index have the same colour (of eight that
// the colour-blind tell apart, those of Okabe and Ito), curves of another
// dash_index other dashes: 0 is solid.
struct AngleCurve {
  std::string name;
  Eigen::VectorXd times_s;
  Eigen::VectorXd values_deg;  // NaN leaves a gap
  Eigen::VectorXd sigmas_deg;  // a band of one on either side; empty: none; NaN: not there
  int color_index = 0;
  int dash_index = 0;
};

struct TimeSpan {
  double from_s = 0.0;
  double to_s = 0.0;
};

// A strip below the curves, dark where the spans are: a foot on the floor.
struct AngleStrip {
  std::string name;
  std::vector<TimeSpan> spans;
};

struct AnglePlot {
  std::string title;
  std::vector<AngleCurve> curves;
  std::vector<TimeSpan> shaded;  // over the whole height: frames that were filled
  std::string shaded_name;       // in the legend
  std::vector<AngleStrip> strips;
  double width_px = 960.0;
  double height_px = 480.0;  // of the curves; legend and strips come below
};

// The text of the SVG file. Throws std::invalid_argument when a curve's vectors
// differ in length, InputError when there is nothing finite to draw.
std::string AnglePlotSvg(const AnglePlot& plot);

}  // namespace poselift
