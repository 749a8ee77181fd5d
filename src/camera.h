// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

namespace poselift {

// Brown's lens distortion with OpenCV's names, rational radial part included.
struct Distortion {
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0, k4 = 0.0, k5 = 0.0, k6 = 0.0;
};

// A pinhole camera with lens distortion, in OpenCV's convention. For a point
// X, Y, Z in cam (x right, y down, z forward):
//   x = X / Z, y = Y / Z, r2 = x^2 + y^2
//   g   = (1 + k1 r2 + k2 r2^2 + k3 r2^3) / (1 + k4 r2 + k5 r2^2 + k6 r2^3)
//   x_d = x g + 2 p1 x y + p2 (r2 + 2 x^2)
//   y_d = y g + p1 (r2 + 2 y^2) + 2 p2 x y
//   pixel = (fx x_d + cx, fy y_d + cy)        integer = pixel centre
struct Camera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0, fy_px = 0.0;
  double cx_px = 0.0, cy_px = 0.0;
  Distortion distortion;

  // Where a point is seen. NaN when it is not before the camera, or so far off
  // the axis that the lens model folds back and would show it twice.
  Eigen::Vector2d Project(const Eigen::Vector3d& x_in_cam) const;

  // The ray (x, y, 1) in cam that is seen at a pixel, by Newton's method to
  // 1e-12. NaN when the lens model shows nothing there.
  Eigen::Vector3d Undistort(const Eigen::Vector2d& x_px) const;

  // What is implausible, with its value; empty when nothing is. Sizes and focal
  // lengths must be positive, all must be finite, and the principal point no
  // further outside than the picture is large.
  std::string Validate() const;
};

// One that nobody calibrated: square pixels, the middle of the picture, no distortion.
Camera UncalibratedCamera(int width_px, int height_px, double focal_px);
// fov_deg: horizontal.
double FocalLength_px(double fov_deg, int width_px);

// The camera with its pictures scaled to that size. Throws InputError, of the camera's file, for a
// size of another shape, by more than a pixel.
Camera AtSize(const Camera& camera, int width_px, int height_px, const std::filesystem::path& file);

}  // namespace poselift
