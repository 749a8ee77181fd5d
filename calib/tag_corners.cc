// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/tag_corners.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace poselift {
namespace {

using Corners = Eigen::Matrix<double, 2, 4>;

constexpr int kRounds = 4;
constexpr int kPlaces = 48;  // along an edge
constexpr int kSteps = 12;   // across it
constexpr double kFarthest_px = 3.0;
constexpr double kMinContrast = 5.0;  // grey levels
constexpr double kConverged_px = 0.002;
// Of the contrast: a level further from its border's is that of another thing.
constexpr double kClear = 0.35;
constexpr int kLeastClear = 16;         // places of an edge
constexpr double kStraggler_px = 0.15;  // from the line, and more than thrice as far as is usual

// Where one place of an edge is sampled: from inside the tag to outside.
struct Crossing {
  Eigen::Vector2d middle_px, outward;
  double reach_px = 0.0;
  double inner = 0.0, outer = 0.0, mean = 0.0;  // grey levels
};
using Edge = std::array<Crossing, kPlaces>;

// NaN outside the picture.
double Bilinear(const cv::Mat& grey, const Eigen::Vector2d& px) {
  if (!(px.x() >= 0.0 && px.y() >= 0.0 && px.x() < grey.cols - 1 && px.y() < grey.rows - 1))
    return std::numeric_limits<double>::quiet_NaN();
  const int x = static_cast<int>(px.x()), y = static_cast<int>(px.y());
  const double fx = px.x() - x, fy = px.y() - y;
  const uchar* above = grey.ptr<uchar>(y) + x;
  const uchar* below = grey.ptr<uchar>(y + 1) + x;
  return (1 - fy) * ((1 - fx) * above[0] + fx * above[1]) +
         fy * ((1 - fx) * below[0] + fx * below[1]);
}

// Edge i runs from corner i to the next; the tag turned by quarters brings it to the top.
Crossing CrossingAt(const Eigen::Matrix3d& px_from_tag, int edge, double along, double half_cell) {
  const auto to_px = [&](double u, double v) -> Eigen::Vector2d {
    for (int quarter = 0; quarter < edge; ++quarter) {
      const double before = u;
      u = -v;
      v = before;
    }
    return (px_from_tag * Eigen::Vector3d(u, v, 1.0)).hnormalized();
  };
  Crossing crossing;
  crossing.middle_px = to_px(along, -1.0);
  const Eigen::Vector2d inner = to_px(along, -1.0 + half_cell);
  const Eigen::Vector2d outer = to_px(along, -1.0 - half_cell);
  crossing.outward = (outer - inner).normalized();
  crossing.reach_px = std::min(0.5 * (outer - inner).norm(), kFarthest_px);
  return crossing;
}

void Sample(const cv::Mat& grey, Crossing* crossing) {
  std::array<double, kSteps + 1> levels{};
  for (int k = 0; k <= kSteps; ++k) {
    const double t = crossing->reach_px * (2.0 * k / kSteps - 1.0);
    levels[static_cast<size_t>(k)] = Bilinear(grey, crossing->middle_px + t * crossing->outward);
  }
  crossing->inner = levels.front();
  crossing->outer = levels.back();
  // Trapezia.
  crossing->mean = -0.5 * (levels.front() + levels.back()) / kSteps;
  for (const double level : levels) crossing->mean += level / kSteps;
}

// A straight line: a point and the normal, n^T (x - p) = 0.
struct Line {
  Eigen::Vector2d point, normal;
};

// The levels beside an edge are smoothed along it: light changes slowly, noise does not.
void SmoothAlong(Edge* edge) {
  const Edge raw = *edge;
  for (int i = 0; i < kPlaces; ++i) {
    Crossing& crossing = (*edge)[static_cast<size_t>(i)];
    const int first = std::max(0, i - 4), last = std::min(kPlaces - 1, i + 4);
    crossing.inner = crossing.outer = 0.0;
    for (int k = first; k <= last; ++k) {
      crossing.inner += raw[static_cast<size_t>(k)].inner / (last - first + 1);
      crossing.outer += raw[static_cast<size_t>(k)].outer / (last - first + 1);
    }
  }
}

// Grey levels of the borders beside two edges that face each other, blurred alike. Quartiles,
// those that are further apart: one of the edges may be hidden.
struct Levels {
  double inner = 0.0, outer = 0.0;
  double Contrast() const { return outer - inner; }
};
Levels LevelsBeside(const Edge& a, const Edge& b) {
  std::array<double, 2 * kPlaces> inner{}, outer{};
  for (size_t i = 0; i < kPlaces; ++i) {
    inner[i] = a[i].inner, inner[kPlaces + i] = b[i].inner;
    outer[i] = a[i].outer, outer[kPlaces + i] = b[i].outer;
  }
  const auto at = [](std::array<double, 2 * kPlaces>* levels, int rank) {
    std::nth_element(levels->begin(), levels->begin() + rank, levels->end());
    return (*levels)[static_cast<size_t>(rank)];
  };
  constexpr int kLow = kPlaces / 2, kHigh = 3 * kPlaces / 2;
  const Levels outward{at(&inner, kLow), at(&outer, kHigh)};
  const Levels inward{at(&inner, kHigh), at(&outer, kLow)};  // of reversed borders
  return std::abs(outward.Contrast()) > std::abs(inward.Contrast()) ? outward : inward;
}

using Points = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kPlaces>;

Line LineThrough(const Points& points) {
  Line line{points.rowwise().mean(), {}};
  const Points off = points.colwise() - line.point;
  const Eigen::Matrix2d scatter = off * off.transpose();
  const double angle = 0.5 * std::atan2(2.0 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  line.normal = {-std::sin(angle), std::cos(angle)};
  return line;
}

// Through the places with the tag's black on one side and its white on the other, without
// those that are off the line: what lies over an edge has another.
bool FitEdge(const Edge& edge, const Levels& levels, Line* line) {
  Points points(2, kPlaces);
  int count = 0;
  for (const Crossing& crossing : edge) {
    if ((crossing.inner - levels.inner) / levels.Contrast() > kClear) continue;
    if ((levels.outer - crossing.outer) / levels.Contrast() > kClear) continue;
    const double t = crossing.reach_px * (crossing.inner + crossing.outer - 2.0 * crossing.mean) /
                     (crossing.outer - crossing.inner);
    points.col(count++) = crossing.middle_px +
                          std::clamp(t, -crossing.reach_px, crossing.reach_px) * crossing.outward;
  }
  if (count < kLeastClear) return false;
  *line = LineThrough(points.leftCols(count));
  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, kPlaces>;
  const Row off_px =
      (line->normal.transpose() * (points.leftCols(count).colwise() - line->point)).cwiseAbs();
  Row sorted_px = off_px;
  std::nth_element(sorted_px.begin(), sorted_px.begin() + count / 2, sorted_px.end());
  const double most_px = std::max(kStraggler_px, 3.0 * sorted_px[count / 2]);
  int kept = 0;
  for (int i = 0; i < count; ++i)
    if (off_px[i] <= most_px) points.col(kept++) = points.col(i);
  if (kept < kLeastClear) return false;
  if (kept < count) *line = LineThrough(points.leftCols(kept));
  return true;
}

Eigen::Vector2d Meet(const Line& a, const Line& b) {
  Eigen::Matrix2d normals;
  normals << a.normal.transpose(), b.normal.transpose();
  return normals.inverse() * Eigen::Vector2d(a.normal.dot(a.point), b.normal.dot(b.point));
}

bool Improve(const cv::Mat& grey, int cells, Corners* corners_px) {
  const Eigen::Matrix3d px_from_tag = PxFromTag(*corners_px);
  const double half_cell = 1.0 / cells;
  std::array<Edge, 4> edges;
  for (int e = 0; e < 4; ++e) {
    Edge& edge = edges[static_cast<size_t>(e)];
    for (int i = 0; i < kPlaces; ++i) {
      const double along = (1.0 - half_cell) * (2.0 * i / (kPlaces - 1) - 1.0);
      edge[static_cast<size_t>(i)] = CrossingAt(px_from_tag, e, along, half_cell);
      Sample(grey, &edge[static_cast<size_t>(i)]);
      if (!std::isfinite(edge[static_cast<size_t>(i)].mean)) return false;
    }
    SmoothAlong(&edge);
  }
  std::array<Line, 4> lines;
  for (size_t e = 0; e < 4; ++e) {
    const Levels levels = LevelsBeside(edges[e % 2], edges[e % 2 + 2]);
    if (!(std::abs(levels.Contrast()) > kMinContrast)) return false;
    if (!FitEdge(edges[e], levels, &lines[e])) return false;
  }
  for (int i = 0; i < 4; ++i)
    corners_px->col(i) =
        Meet(lines[static_cast<size_t>((i + 3) % 4)], lines[static_cast<size_t>(i)]);
  return corners_px->allFinite();
}

}  // namespace

Eigen::Matrix3d PxFromTag(const Corners& corners_px) {
  const Eigen::Vector2d a = corners_px.col(0), b = corners_px.col(1), c = corners_px.col(2),
                        d = corners_px.col(3);
  // The unit square first: (0, 0), (1, 0), (1, 1), (0, 1).
  Eigen::Matrix2d sides;
  sides << b - c, d - c;
  const Eigen::Vector2d g = sides.inverse() * (a - b + c - d);
  Eigen::Matrix3d px_from_unit;
  px_from_unit << (1.0 + g.x()) * b - a, (1.0 + g.y()) * d - a, a, g.x(), g.y(), 1.0;
  Eigen::Matrix3d unit_from_tag;
  unit_from_tag << 0.5, 0.0, 0.5, 0.0, 0.5, 0.5, 0.0, 0.0, 1.0;
  const Eigen::Matrix3d px_from_tag = px_from_unit * unit_from_tag;
  return px_from_tag / px_from_tag(2, 2);
}

bool RefineTagCorners(const cv::Mat& grey, int cells, Corners* corners_px) {
  const double cell_px = (corners_px->col(2) - corners_px->col(0)).norm() / cells;
  Corners refined_px = *corners_px;
  for (int round = 0; round < kRounds; ++round) {
    const Corners before_px = refined_px;
    if (!Improve(grey, cells, &refined_px)) return false;
    const double moved_px = (refined_px - before_px).cwiseAbs().maxCoeff();
    if (moved_px < kConverged_px) break;
  }
  if ((refined_px - *corners_px).cwiseAbs().maxCoeff() > std::max(cell_px, 1.0)) return false;
  *corners_px = refined_px;
  return true;
}

}  // namespace poselift
