// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/saddle_points.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace poselift {
namespace {

// What is the same for all points of one radius.
struct Quadric {
  int radius_px;
  cv::Mat cone;
  std::vector<Eigen::Vector2d> offsets_px;
  Eigen::MatrixXd from_levels;  // 6 x offsets: x^2, xy, y^2, x, y, 1

  explicit Quadric(int radius) : radius_px(radius), cone(2 * radius + 1, 2 * radius + 1, CV_32F) {
    for (int y = -radius; y <= radius; ++y)
      for (int x = -radius; x <= radius; ++x) {
        const double distance = std::hypot(x, y);
        cone.at<float>(y + radius, x + radius) =
            static_cast<float>(std::max(0.0, radius + 1.0 - distance));
        if (distance <= radius) offsets_px.emplace_back(x, y);
      }
    cone /= cv::sum(cone)[0];
    Eigen::MatrixXd powers(static_cast<Eigen::Index>(offsets_px.size()), 6);
    for (Eigen::Index i = 0; i < powers.rows(); ++i) {
      const double x = offsets_px[static_cast<size_t>(i)].x();
      const double y = offsets_px[static_cast<size_t>(i)].y();
      powers.row(i) << x * x, x * y, y * y, x, y, 1.0;
    }
    from_levels = powers.completeOrthogonalDecomposition().pseudoInverse();
  }
};

double LevelAt(const cv::Mat& levels, const Eigen::Vector2d& x_px) {
  const double x = std::clamp(x_px.x(), 0.0, levels.cols - 1.001);
  const double y = std::clamp(x_px.y(), 0.0, levels.rows - 1.001);
  const int u = static_cast<int>(x), v = static_cast<int>(y);
  const double a = x - u, b = y - v;
  const float* row = levels.ptr<float>(v) + u;
  const float* below = levels.ptr<float>(v + 1) + u;
  return (1 - b) * ((1 - a) * row[0] + a * row[1]) + b * ((1 - a) * below[0] + a * below[1]);
}

// From x to the saddle of the quadric around it; nothing where it has none.
std::optional<Eigen::Vector2d> StepToSaddle(const cv::Mat& levels, const Quadric& quadric,
                                            const Eigen::Vector2d& x_px) {
  Eigen::VectorXd around(static_cast<Eigen::Index>(quadric.offsets_px.size()));
  for (Eigen::Index i = 0; i < around.size(); ++i)
    around[i] = LevelAt(levels, x_px + quadric.offsets_px[static_cast<size_t>(i)]);
  const Eigen::Matrix<double, 6, 1> q = quadric.from_levels * around;
  Eigen::Matrix2d hessian;
  hessian << 2.0 * q[0], q[1], q[1], 2.0 * q[2];
  if (!(hessian.determinant() < 0.0)) return std::nullopt;
  return -hessian.inverse() * q.segment<2>(3);
}

std::optional<cv::Point2f> SaddleNear(const cv::Mat& grey, const Quadric& quadric,
                                      const cv::Point2f& start_px) {
  constexpr int kMostSteps = 20;
  constexpr double kTolerance_px = 1e-3;
  const int reach_px = 3 * quadric.radius_px + 2;  // of the smoothed levels that are looked at
  const cv::Rect patch = cv::Rect(cvRound(start_px.x) - reach_px, cvRound(start_px.y) - reach_px,
                                  2 * reach_px + 1, 2 * reach_px + 1) &
                         cv::Rect(0, 0, grey.cols, grey.rows);
  if (patch.width < 2 || patch.height < 2) return std::nullopt;
  cv::Mat levels;
  cv::filter2D(grey(patch), levels, CV_32F, quadric.cone, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  const Eigen::Vector2d start(start_px.x - patch.x, start_px.y - patch.y);
  Eigen::Vector2d x = start;
  for (int i = 0; i < kMostSteps; ++i) {
    const auto step = StepToSaddle(levels, quadric, x);
    if (!step || !((x + *step - start).norm() < quadric.radius_px)) return std::nullopt;
    x += *step;
    if (step->norm() < kTolerance_px)
      return cv::Point2f(static_cast<float>(x.x() + patch.x), static_cast<float>(x.y() + patch.y));
  }
  return std::nullopt;
}

}  // namespace

void RefineSaddlePoints(const cv::Mat& grey, int radius_px, std::vector<cv::Point2f>* points_px) {
  const Quadric quadric(radius_px);
  for (cv::Point2f& point : *points_px)
    if (const auto saddle = SaddleNear(grey, quadric, point)) point = *saddle;
}

}  // namespace poselift
