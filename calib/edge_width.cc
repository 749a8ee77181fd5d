// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/edge_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace poselift {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kStep_px = 0.25;

// NaN outside of the picture.
double Bilinear(const cv::Mat& grey, const Eigen::Vector2d& at_px) {
  const int x = static_cast<int>(std::floor(at_px.x()));
  const int y = static_cast<int>(std::floor(at_px.y()));
  if (x < 0 || y < 0 || x + 1 >= grey.cols || y + 1 >= grey.rows) return kNaN;
  const double u = at_px.x() - x;
  const double v = at_px.y() - y;
  const uchar* const upper = grey.ptr(y) + x;
  const uchar* const lower = grey.ptr(y + 1) + x;
  return (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
}

// Grey across the edge, from inside to outside, mean of its middle part.
std::vector<double> Profile(const cv::Mat& grey, const Eigen::Vector2d& begin_px,
                            const Eigen::Vector2d& end_px, const Eigen::Vector2d& outwards,
                            double reach_px) {
  constexpr int kPlaces = 24;
  const int half = static_cast<int>(reach_px / kStep_px);
  std::vector<double> profile(static_cast<size_t>(2 * half + 1), 0.0);
  for (int place = 0; place < kPlaces; ++place) {
    const double along = 0.2 + 0.6 * place / (kPlaces - 1);
    const Eigen::Vector2d middle_px = begin_px + along * (end_px - begin_px);
    for (int i = -half; i <= half; ++i)
      profile[static_cast<size_t>(i + half)] +=
          Bilinear(grey, middle_px + i * kStep_px * outwards) / kPlaces;
  }
  return profile;
}

// In steps, from the darkest place inside to the brightest outside: what lies beyond is other
// cells or other paper. NaN where there is no such rise.
double RiseSteps(const std::vector<double>& profile) {
  constexpr double kMinContrast = 30.0;
  const auto middle = profile.begin() + static_cast<std::ptrdiff_t>(profile.size() / 2);
  const auto black = std::min_element(profile.begin(), middle);
  const auto white = std::max_element(middle, profile.end());
  const double rise = *white - *black;
  if (!(rise > kMinContrast)) return kNaN;
  const auto crossing = [&](double level) {
    const auto above = std::find_if(black, white, [&](double grey) { return grey >= level; });
    return static_cast<double>(above - black) - (*above - level) / (*above - *(above - 1));
  };
  return crossing(*black + 0.9 * rise) - crossing(*black + 0.1 * rise);
}

double Width_px(const cv::Mat& grey, const TagDetection& tag, int edge, int cells) {
  constexpr double kMinCell_px = 3.0;
  const Eigen::Vector2d begin_px = tag.corners_px.col(edge);
  const Eigen::Vector2d end_px = tag.corners_px.col((edge + 1) % 4);
  const double length_px = (end_px - begin_px).norm();
  const double cell_px = length_px / cells;
  if (!(cell_px >= kMinCell_px)) return kNaN;
  const Eigen::Vector2d along = (end_px - begin_px) / length_px;
  // The corners go round clockwise in the picture, whose y points down.
  const Eigen::Vector2d outwards(along.y(), -along.x());
  // Enough for an edge a cell wide, and no more, for other edges follow.
  const std::vector<double> profile = Profile(grey, begin_px, end_px, outwards, 0.65 * cell_px);
  return kStep_px * RiseSteps(profile);
}

}  // namespace

std::array<double, 2> EdgeWidths_px(const cv::Mat& grey, const TagDetection& tag,
                                    int cells_of_size) {
  const auto width_px = [&](int edge) { return Width_px(grey, tag, edge, cells_of_size); };
  return {std::fmin(width_px(0), width_px(2)), std::fmin(width_px(1), width_px(3))};
}

}  // namespace poselift
