// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/round_cone.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poselift::testing {
namespace {

constexpr float kMiss = std::numeric_limits<float>::infinity();

// Where the ray eye + z d enters a sphere about (0, y, 0).
float SphereDepth(const Eigen::Vector3f& eye, const Eigen::Vector3f& d, float y, float radius) {
  const Eigen::Vector3f o(eye.x(), eye.y() - y, eye.z());
  const float a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - radius * radius;
  const float h = b * b - a * c;
  return h < 0 ? kMiss : (-b - std::sqrt(h)) / a;
}

}  // namespace

SeenRoundCone::SeenRoundCone(const RoundCone& cone, const Eigen::Isometry3d& cam_from_cone) {
  Eigen::Vector3d axis = (cone.tip_m - cone.start_m).cwiseQuotient(cone.stretch);
  double length_m = axis.norm();
  double start_radius_m = cone.start_radius_m, tip_radius_m = cone.tip_radius_m;
  Eigen::Vector3d start_m = cone.start_m;
  // A sphere inside the other: that one is all.
  if (length_m <= std::abs(start_radius_m - tip_radius_m)) {
    if (tip_radius_m > start_radius_m) start_m = cone.tip_m;
    start_radius_m = tip_radius_m = std::max(start_radius_m, tip_radius_m);
    length_m = 0.0;
    axis = Eigen::Vector3d::UnitY();
  }
  const Eigen::Matrix3d local_from_cone =
      Eigen::Quaterniond::FromTwoVectors(axis, Eigen::Vector3d::UnitY()).matrix() *
      cone.stretch.cwiseInverse().asDiagonal();
  const Eigen::Matrix3d local_from_cam = local_from_cone * cam_from_cone.linear().transpose();
  const Eigen::Vector3d start_in_cam_m = cam_from_cone * start_m;
  local_from_cam_ = local_from_cam.cast<float>();
  eye_ = (-local_from_cam * start_in_cam_m).cast<float>();
  length_ = static_cast<float>(length_m);
  start_radius_ = static_cast<float>(start_radius_m);
  tip_radius_ = static_cast<float>(tip_radius_m);
  sin_ = length_ > 0 ? (start_radius_ - tip_radius_) / length_ : 0.0f;
  cos_ = std::sqrt(1 - sin_ * sin_);
  const float at_eye = start_radius_ - sin_ * eye_.y();
  eye_term_ = cos_ * cos_ * (eye_.x() * eye_.x() + eye_.z() * eye_.z()) - at_eye * at_eye;

  const Eigen::Matrix3d half_axes = cam_from_cone.linear() * cone.stretch.asDiagonal();
  const Eigen::Vector3d reach = half_axes.rowwise().norm();
  const Eigen::Vector3d end_in_cam_m = length_m > 0 ? cam_from_cone * cone.tip_m : start_in_cam_m;
  box_.extend(start_in_cam_m - start_radius_m * reach);
  box_.extend(start_in_cam_m + start_radius_m * reach);
  box_.extend(end_in_cam_m - tip_radius_m * reach);
  box_.extend(end_in_cam_m + tip_radius_m * reach);
}

// With rho the distance from the axis, the cone's side is
//   rho cos = r - y sin,   r sin <= y <= length + r_tip sin,
// squared a quadratic in z. A ray steeper than the side (a > 0) enters the body where it
// enters the endless cone, or through the sphere at that end. For others the first of all
// that it may meet counts: the body is their union.
float SeenRoundCone::Depth_m(const Ray& ray) const {
  const Eigen::Vector3f d =
      local_from_cam_.col(0) * ray.x() + local_from_cam_.col(1) * ray.y() + local_from_cam_.col(2);
  const float c2 = cos_ * cos_;
  const float at_eye = start_radius_ - sin_ * eye_.y();
  const float a = c2 * (d.x() * d.x() + d.z() * d.z()) - sin_ * sin_ * d.y() * d.y();
  const float b = c2 * (eye_.x() * d.x() + eye_.z() * d.z()) + sin_ * d.y() * at_eye;
  const float h = b * b - a * eye_term_;
  if (a > 0 && h < 0) return kMiss;
  const float low = start_radius_ * sin_, high = length_ + tip_radius_ * sin_;
  const float root = std::sqrt(std::max(0.0f, h));
  float depth = kMiss;
  if (a > 0) {
    const float z = (-b - root) / a, y = eye_.y() + z * d.y();
    const bool is_at_start = y < low;
    depth = !is_at_start && y <= high ? z
            : is_at_start             ? SphereDepth(eye_, d, 0.0f, start_radius_)
                                      : SphereDepth(eye_, d, length_, tip_radius_);
  } else {
    for (const float z : {(-b - root) / a, (-b + root) / a}) {
      const float y = eye_.y() + z * d.y();
      if (z > 0 && y >= low && y <= high) depth = std::min(depth, z);
    }
    depth = std::min({depth, SphereDepth(eye_, d, 0.0f, start_radius_),
                      SphereDepth(eye_, d, length_, tip_radius_)});
  }
  return depth > 0 ? depth : kMiss;
}

Eigen::Vector3f SeenRoundCone::Normal(const Ray& ray, float depth_m) const {
  const Eigen::Vector3f at =
      eye_ + depth_m * (local_from_cam_ * Eigen::Vector3f(ray.x(), ray.y(), 1.0f));
  const float rho = std::sqrt(at.x() * at.x() + at.z() * at.z());
  // The sphere of the axis that touches the surface here.
  const float center = std::clamp(at.y() - rho * sin_ / cos_, 0.0f, length_);
  const Eigen::Vector3f normal(at.x(), at.y() - center, at.z());
  return (local_from_cam_.transpose() * normal).normalized();
}

}  // namespace poselift::testing
