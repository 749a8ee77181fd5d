// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/camera.h"

#include <fmt/core.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kLargestSize_px = 100000;
constexpr double kLargestCoefficient = 1e6;

struct Distorted {
  Eigen::Vector2d x;         // normalised, distorted
  Eigen::Matrix2d jacobian;  // d x / d undistorted
};

Distorted Distort(const Distortion& d, const Eigen::Vector2d& undistorted) {
  const double x = undistorted.x(), y = undistorted.y();
  const double r2 = x * x + y * y;
  const double above = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double below = 1 + r2 * (d.k4 + r2 * (d.k5 + r2 * d.k6));
  const double above_slope = d.k1 + r2 * (2 * d.k2 + r2 * 3 * d.k3);
  const double below_slope = d.k4 + r2 * (2 * d.k5 + r2 * 3 * d.k6);
  const double g = above / below;
  const double g_slope = (above_slope - g * below_slope) / below;
  Distorted result;
  result.x << x * g + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x),
      y * g + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y;
  const double mixed = 2 * x * y * g_slope + 2 * d.p1 * x + 2 * d.p2 * y;
  result.jacobian << g + 2 * x * x * g_slope + 2 * d.p1 * y + 6 * d.p2 * x, mixed, mixed,
      g + 2 * y * y * g_slope + 6 * d.p1 * y + 2 * d.p2 * x;
  return result;
}

// Not folded back: near the axis the determinant is 1, at the fold it is 0.
bool IsOnTheFirstSheet(const Distorted& distorted) { return distorted.jacobian.determinant() > 0; }

Eigen::Vector2d Step(const Distorted& at, const Eigen::Vector2d& wanted) {
  return at.jacobian.inverse() * (wanted - at.x);
}

}  // namespace

Eigen::Vector2d Camera::Project(const Eigen::Vector3d& x_in_cam) const {
  if (!(x_in_cam.z() > 0)) return Eigen::Vector2d::Constant(kNaN);
  const Distorted distorted = Distort(distortion, x_in_cam.head<2>() / x_in_cam.z());
  if (!IsOnTheFirstSheet(distorted)) return Eigen::Vector2d::Constant(kNaN);
  return {fx_px * distorted.x.x() + cx_px, fy_px * distorted.x.y() + cy_px};
}

Eigen::Vector3d Camera::Undistort(const Eigen::Vector2d& x_px) const {
  constexpr int kMostIterations = 50;
  constexpr double kTolerance = 1e-12;
  const Eigen::Vector2d wanted((x_px.x() - cx_px) / fx_px, (x_px.y() - cy_px) / fy_px);
  Eigen::Vector2d x = wanted;
  Distorted at = Distort(distortion, x);
  // A strong barrel may be folded back at the distorted point: begin nearer.
  for (int i = 0; i < kMostIterations && !IsOnTheFirstSheet(at); ++i)
    at = Distort(distortion, x *= 0.7);
  for (int i = 0; i < kMostIterations; ++i) {
    const double residual = (wanted - at.x).norm();
    if (residual <= kTolerance * (1 + wanted.norm()) && IsOnTheFirstSheet(at))
      return {x.x(), x.y(), 1.0};
    Eigen::Vector2d step = Step(at, wanted);
    Distorted next = Distort(distortion, x + step);
    for (int k = 0;
         k < kMostIterations && !((wanted - next.x).norm() < residual && IsOnTheFirstSheet(next));
         ++k)
      next = Distort(distortion, x + (step *= 0.5));
    x += step;
    at = next;
  }
  return Eigen::Vector3d::Constant(kNaN);
}

std::string Camera::Validate() const {
  if (width_px <= 0 || height_px <= 0 || width_px > kLargestSize_px || height_px > kLargestSize_px)
    return fmt::format("found the picture size {} x {}, wanted 1 to {} pixels", width_px, height_px,
                       kLargestSize_px);
  const double size_px = std::hypot(width_px, height_px);
  for (const double f_px : {fx_px, fy_px})
    if (!(f_px > 0.01 * size_px && f_px < 1000 * size_px))
      return fmt::format(
          "found the focal length {:g} px, wanted one between {:g} and {:g} px for this picture",
          f_px, 0.01 * size_px, 1000 * size_px);
  if (!(std::abs(cx_px - width_px / 2.0) < 1.5 * width_px &&
        std::abs(cy_px - height_px / 2.0) < 1.5 * height_px))
    return fmt::format("found the principal point ({:g}, {:g}) px, wanted one near the picture",
                       cx_px, cy_px);
  const Distortion& d = distortion;
  for (const double k : {d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6})
    if (!(std::abs(k) < kLargestCoefficient))
      return fmt::format("found the distortion coefficient {:g}, wanted one below {:g}", k,
                         kLargestCoefficient);
  return {};
}

Camera UncalibratedCamera(int width_px, int height_px, double focal_px) {
  return {.width_px = width_px,
          .height_px = height_px,
          .fx_px = focal_px,
          .fy_px = focal_px,
          .cx_px = 0.5 * width_px - 0.5,
          .cy_px = 0.5 * height_px - 0.5};
}

double FocalLength_px(double fov_deg, int width_px) {
  return 0.5 * width_px / std::tan(fov_deg * std::numbers::pi / 360.0);
}

Camera AtSize(const Camera& camera, int width_px, int height_px,
              const std::filesystem::path& file) {
  const double scale = static_cast<double>(width_px) / camera.width_px;
  if (std::abs(scale * camera.height_px - height_px) > 1.0)
    throw InputError(file,
                     fmt::format("found a camera of {} x {} pixels and pictures of {} x {}, wanted "
                                 "the same shape: calibrate at the size that is used",
                                 camera.width_px, camera.height_px, width_px, height_px));
  Camera scaled = camera;
  scaled.fx_px *= scale;
  scaled.fy_px *= scale;
  scaled.cx_px = scale * (camera.cx_px + 0.5) - 0.5;
  scaled.cy_px = scale * (camera.cy_px + 0.5) - 0.5;
  scaled.width_px = width_px;
  scaled.height_px = height_px;
  return scaled;
}

}  // namespace poselift
