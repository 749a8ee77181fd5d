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

// The levels beside the edge are smoothed along it: light changes slowly, noise does not.
bool FitEdge(const Edge& edge, Line* line) {
  Eigen::Matrix<double, 2, kPlaces> points;
  for (int i = 0; i < kPlaces; ++i) {
    double inner = 0.0, outer = 0.0;
    const int first = std::max(0, i - 4), last = std::min(kPlaces - 1, i + 4);
    for (int k = first; k <= last; ++k) {
      inner += edge[static_cast<size_t>(k)].inner / (last - first + 1);
      outer += edge[static_cast<size_t>(k)].outer / (last - first + 1);
    }
    const Crossing& crossing = edge[static_cast<size_t>(i)];
    const double contrast = outer - inner;
    if (!(std::abs(contrast) > kMinContrast)) return false;  // NaN too
    const double t = crossing.reach_px * (inner + outer - 2.0 * crossing.mean) / contrast;
    points.col(i) = crossing.middle_px +
                    std::clamp(t, -crossing.reach_px, crossing.reach_px) * crossing.outward;
  }
  line->point = points.rowwise().mean();
  points.colwise() -= line->point;
  const Eigen::Matrix2d scatter = points * points.transpose();
  const double angle = 0.5 * std::atan2(2.0 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  line->normal = {-std::sin(angle), std::cos(angle)};
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
  std::array<Line, 4> lines;
  for (int e = 0; e < 4; ++e) {
    Edge edge;
    for (int i = 0; i < kPlaces; ++i) {
      const double along = (1.0 - half_cell) * (2.0 * i / (kPlaces - 1) - 1.0);
      edge[static_cast<size_t>(i)] = CrossingAt(px_from_tag, e, along, half_cell);
      Sample(grey, &edge[static_cast<size_t>(i)]);
    }
    if (!FitEdge(edge, &lines[static_cast<size_t>(e)])) return false;
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
