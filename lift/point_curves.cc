// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/point_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lift/baselines/butterworth.h"
#include "lift/baselines/interpolation.h"

namespace poselift {
namespace {

Eigen::Index IndexOf(const std::vector<ObservedPoint>& points, const std::string& name) {
  const auto found = std::find_if(points.begin(), points.end(),
                                  [&](const ObservedPoint& point) { return point.name == name; });
  return found - points.begin();
}

// Frames before the first value and after the last one are held by FillGaps:
// that is no more known than anything.
void ForgetEnds(const Eigen::MatrixXd& seen, Eigen::MatrixXd* curves) {
  for (Eigen::Index row = 0; row < seen.rows(); ++row) {
    const auto blank = [&](Eigen::Index t) { (*curves)(row, t) = std::nan(""); };
    for (Eigen::Index t = 0; t < seen.cols() && std::isnan(seen(row, t)); ++t) blank(t);
    for (Eigen::Index t = seen.cols(); t-- > 0 && std::isnan(seen(row, t));) blank(t);
  }
}

}  // namespace

std::vector<ObservedPoint> PointsOf(const std::vector<Observation>& frames) {
  std::vector<ObservedPoint> points;
  for (const Observation& frame : frames)
    for (const ObservedPoint& point : frame.points)
      if (IndexOf(points, point.name) == std::ssize(points)) points.push_back(point);
  return points;
}

std::vector<Observation> SmoothPoints(const std::vector<Observation>& frames, double frame_time_s,
                                      double cutoff_hz, int max_gap_frames) {
  std::vector<ObservedPoint> points = PointsOf(frames);
  std::erase_if(points, [](const ObservedPoint& p) { return p.kind != ObservedPoint::Kind::k2D; });
  const auto num_points = std::ssize(points);
  const auto num_frames = std::ssize(frames);
  Eigen::MatrixXd seen = Eigen::MatrixXd::Constant(2 * num_points, num_frames, std::nan(""));
  Eigen::VectorXd sigmas = Eigen::VectorXd::Zero(num_points), counts = sigmas;
  for (Eigen::Index t = 0; t < num_frames; ++t)
    for (const ObservedPoint& point : frames[static_cast<size_t>(t)].points) {
      const Eigen::Index i = IndexOf(points, point.name);
      if (point.kind != ObservedPoint::Kind::k2D) continue;
      seen.block<2, 1>(2 * i, t) = point.x.head<2>();
      sigmas[i] += point.sigma;
      counts[i] += 1.0;
    }
  sigmas.array() /= counts.array();

  Eigen::MatrixXd curves = FillGaps(seen, GapFill::kLinear, max_gap_frames).curves;
  ForgetEnds(seen, &curves);
  const double rate_hz = 1.0 / frame_time_s;
  if (cutoff_hz > 0.0 && cutoff_hz < 0.45 * rate_hz)
    curves = ButterworthLowPass(curves, rate_hz, {.cutoff_hz = cutoff_hz});

  std::vector<Observation> smooth = frames;
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    std::vector<ObservedPoint>& now = smooth[static_cast<size_t>(t)].points;
    for (Eigen::Index i = 0; i < num_points; ++i) {
      if (std::isnan(curves(2 * i, t))) continue;
      const Eigen::Vector3d x(curves(2 * i, t), curves(2 * i + 1, t), 0.0);
      const Eigen::Index place = IndexOf(now, points[static_cast<size_t>(i)].name);
      if (place < std::ssize(now)) {
        now[static_cast<size_t>(place)].x = x;
        continue;
      }
      ObservedPoint filled = points[static_cast<size_t>(i)];
      filled.x = x;
      filled.sigma = 2.0 * sigmas[i];
      filled.state = LabelState::kOccluded;
      now.push_back(std::move(filled));
    }
  }
  return smooth;
}

}  // namespace poselift
