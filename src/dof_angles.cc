// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/dof_angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace poselift {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// Closer to the lock than this the split between the two outer angles is noise.
constexpr double kGimbalLock = 1e-8;

Eigen::Matrix3d AxisRotation(int axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

double NearestTurn(double angle_rad, double previous_rad) {
  return angle_rad + kTurn * std::round((previous_rad - angle_rad) / kTurn);
}

// The angle about one axis that brings Rot(axis, angle) closest to `rotation`:
// the maximum of trace(Rot^T rotation).
double BestAngle(const Eigen::Matrix3d& rotation, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return std::atan2(rotation(v, u) - rotation(u, v), rotation(u, u) + rotation(v, v));
}

struct RotationDofs {
  int count = 0;
  std::array<int, 3> axis{};
  std::array<int, 3> index{};  // among the dofs of the bone
};

RotationDofs FindRotations(std::span<const Dof> dofs) {
  RotationDofs found;
  for (size_t i = 0; i < dofs.size(); ++i) {
    if (!dofs[i].IsRotation()) continue;
    for (int k = 0; k < found.count; ++k)
      if (found.axis[k] == dofs[i].Axis())
        throw std::invalid_argument("a bone turns twice about the same axis");
    found.axis[found.count] = dofs[i].Axis();
    found.index[found.count++] = static_cast<int>(i);
  }
  return found;
}

using Angles = std::array<double, 3>;

// R = R_k(c) R_j(b) R_i(a): row k of R holds a and b; c fits what is left, so
// that R comes out right however small cos b is.
Angles FitThree(const Eigen::Matrix3d& R, const RotationDofs& dofs, const Angles& previous) {
  const auto [i, j, k] = dofs.axis;
  const double sign = j == (i + 1) % 3 ? 1.0 : -1.0;
  const double cos_b = std::hypot(R(k, j), R(k, k));
  const double b = std::atan2(-sign * R(k, i), cos_b);
  const double a = cos_b < kGimbalLock ? previous[0] : std::atan2(sign * R(k, j), R(k, k));
  Angles best{};
  double best_distance = HUGE_VAL;
  for (const auto& [inner, middle] : {std::pair(a, b), std::pair(a + kTurn / 2, kTurn / 2 - b)}) {
    const Eigen::Matrix3d rest = R * (AxisRotation(j, middle) * AxisRotation(i, inner)).transpose();
    const Angles angles = {NearestTurn(inner, previous[0]), NearestTurn(middle, previous[1]),
                           NearestTurn(BestAngle(rest, k), previous[2])};
    double distance = 0.0;
    for (int n = 0; n < 3; ++n) distance += std::pow(angles[n] - previous[n], 2);
    if (!(distance >= best_distance)) {  // a NaN stays one
      best_distance = distance;
      best = angles;
    }
  }
  return best;
}

// R_b(beta) R_a(alpha): exact from the image of axis a when R is such a
// product; then each angle in turn takes its best value.
Angles FitTwo(const Eigen::Matrix3d& R, const RotationDofs& dofs, const Angles& previous) {
  const int a = dofs.axis[0];
  const int b = dofs.axis[1];
  const int u = (b + 1) % 3;
  const int v = (b + 2) % 3;
  const Eigen::Vector3d image = R.col(a);
  double beta = std::atan2(image[v], image[u]) - (a == u ? 0.0 : kTurn / 4);
  double alpha = BestAngle(AxisRotation(b, -beta) * R, a);
  constexpr int kMostSteps = 50;
  for (int step = 0; step < kMostSteps; ++step) {
    const double last = beta;
    beta = NearestTurn(BestAngle(R * AxisRotation(a, -alpha), b), beta);
    alpha = BestAngle(AxisRotation(b, -beta) * R, a);
    if (std::abs(beta - last) < 1e-12) break;
  }
  return {NearestTurn(alpha, previous[0]), NearestTurn(beta, previous[1])};
}

}  // namespace

Eigen::Matrix3d RotationOfDofs(std::span<const Dof> dofs, const double* values) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (size_t i = 0; i < dofs.size(); ++i)
    if (dofs[i].IsRotation()) rotation = AxisRotation(dofs[i].Axis(), values[i]) * rotation;
  return rotation;
}

double FitDofAngles(const Eigen::Matrix3d& rotation, std::span<const Dof> dofs, double* values) {
  const RotationDofs found = FindRotations(dofs);
  Angles previous{};
  for (int n = 0; n < found.count; ++n) previous[n] = values[found.index[n]];
  Angles angles{};
  if (found.count == 3) angles = FitThree(rotation, found, previous);
  if (found.count == 2) angles = FitTwo(rotation, found, previous);
  if (found.count == 1) angles[0] = NearestTurn(BestAngle(rotation, found.axis[0]), previous[0]);
  for (int n = 0; n < found.count; ++n) values[found.index[n]] = angles[n];
  return AngleBetween(rotation, RotationOfDofs(dofs, values));
}

double AngleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return 2.0 * std::asin(std::min(1.0, (a - b).norm() / (2.0 * std::numbers::sqrt2)));
}

}  // namespace poselift
