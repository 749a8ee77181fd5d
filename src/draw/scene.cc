// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/joints.h"
#include "src/units.h"

namespace poselift {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFarthest_m = 1e4;
constexpr double kSmallestRadius_m = 0.3;
constexpr double kEyeDistance = 8.0;  // radii

Pose3 WithoutWildJoints(const Pose3& joints) {
  Pose3 kept = joints;
  for (int j = 0; j < kept.cols(); ++j)
    if (!(kept.col(j).array().abs() < kFarthest_m).all())
      kept.col(j).setConstant(std::numeric_limits<double>::quiet_NaN());
  return kept;
}

void Include(const Pose3& joints, Vector3d* low, Vector3d* high) {
  for (int j = 0; j < joints.cols(); ++j) {
    if (joints.col(j).hasNaN()) continue;
    *low = low->cwiseMin(joints.col(j));
    *high = high->cwiseMax(joints.col(j));
  }
}

// Where the camera looks, along the floor; where the top of its picture points
// when it looks straight down.
Vector3d LevelAway(const Vector3d& up) {
  const auto level = [&](const Vector3d& x) -> Vector3d { return x - x.dot(up) * up; };
  const Vector3d forward = level(Vector3d::UnitZ());
  return (forward.norm() > 0.2 ? forward : level(-Vector3d::UnitY())).normalized();
}

double GridStep(double radius_m) {
  double step_m = 0.5;
  for (int i = 0; radius_m / step_m > 12.0; ++i) step_m *= i % 3 == 2 ? 2.5 : 2.0;
  return step_m;
}

// How much smaller what lies at z is than what lies at 0.
double Shrink(const View& view, double z_m) {
  return view.eye_distance_m > 0.0 ? view.eye_distance_m / (view.eye_distance_m + z_m) : 1.0;
}

Matrix3d Rows(const Vector3d& x, const Vector3d& y, const Vector3d& z) {
  Matrix3d rows;
  rows << x.transpose(), y.transpose(), z.transpose();
  return rows;
}

}  // namespace

Vector3d Scene::OnFloor(const Vector3d& x_in_cam_m) const {
  return x_in_cam_m + (base_in_cam_m - x_in_cam_m).dot(up) * up;
}

Pose3 Scene::Shadow() const {
  Pose3 shadow = joints_in_cam_m;
  for (int j = 0; j < shadow.cols(); ++j) shadow.col(j) = OnFloor(joints_in_cam_m.col(j));
  return shadow;
}

Scene MakeScene(const Pose3& joints_in_cam_m, const std::vector<Pose3>& others_in_cam_m,
                const Vector3d& up_in_cam) {
  Scene scene;
  scene.joints_in_cam_m = WithoutWildJoints(joints_in_cam_m);
  for (const Pose3& other : others_in_cam_m)
    scene.others_in_cam_m.push_back(WithoutWildJoints(other));
  scene.up = up_in_cam.normalized();
  scene.away = LevelAway(scene.up);
  scene.right = (-scene.up).cross(scene.away);

  Vector3d low = Vector3d::Constant(kFarthest_m), high = -low;
  Include(scene.joints_in_cam_m, &low, &high);
  for (const Pose3& other : scene.others_in_cam_m) Include(other, &low, &high);
  if (low.x() > high.x()) low = high = Vector3d::Zero();
  scene.center_in_cam_m = 0.5 * (low + high);
  scene.radius_m = std::max(kSmallestRadius_m, 0.5 * (high - low).norm());
  scene.grid_step_m = GridStep(scene.radius_m);

  double lowest_m = std::numeric_limits<double>::infinity();
  for (int j = 0; j < kNumJoints; ++j)  // a NaN is never the smaller
    lowest_m = std::fmin(lowest_m, scene.joints_in_cam_m.col(j).dot(scene.up));
  const Vector3d pelvis = scene.joints_in_cam_m.col(joint::kPelvis);
  scene.base_in_cam_m = pelvis.hasNaN() ? scene.center_in_cam_m : pelvis;
  if (std::isfinite(lowest_m))
    scene.base_in_cam_m += (lowest_m - scene.base_in_cam_m.dot(scene.up)) * scene.up;
  return scene;
}

std::vector<View> StandardViews(const Scene& scene) {
  const double distance_m = kEyeDistance * scene.radius_m;
  const Vector3d down = -scene.up;
  const auto raised_eye = [&](const Matrix3d& view_from_cam) -> Eigen::Vector2d {
    return (view_from_cam * (0.8 * scene.radius_m * scene.up)).head<2>();
  };
  const Matrix3d front = Matrix3d::Identity();
  const Matrix3d side = Rows(scene.away, down, -scene.right);
  const Matrix3d above = Rows(scene.right, -scene.away, down);
  return {{"front: as the camera sees it", front, distance_m, raised_eye(front)},
          {"side: from the camera's right", side, distance_m, raised_eye(side)},
          {"above", above},
          OrbitView(scene, 40.0 * kRadFromDeg, 20.0 * kRadFromDeg)};
}

View OrbitView(const Scene& scene, double yaw_rad, double pitch_rad) {
  const Vector3d down = -scene.up;
  const Vector3d ahead = std::cos(yaw_rad) * scene.away - std::sin(yaw_rad) * scene.right;
  const Vector3d ahead_down = std::cos(pitch_rad) * ahead + std::sin(pitch_rad) * down;
  const Vector3d across = down.cross(ahead);
  const Matrix3d view_from_cam = Rows(across, ahead_down.cross(across), ahead_down);
  return {"three-quarter", view_from_cam, kEyeDistance * scene.radius_m};
}

Vector3d Projection::InCam(const Eigen::Vector2d& x_px, const Vector3d& as_far_in_cam_m) const {
  const double z_m = view.view_from_cam.row(2).dot(as_far_in_cam_m - center_in_cam_m);
  const Eigen::Vector2d flat = (x_px - offset_px) / scale_px_per_m;
  Vector3d x;
  x << view.eye_in_view_m + (flat - view.eye_in_view_m) / Shrink(view, z_m), z_m;
  return center_in_cam_m + view.view_from_cam.transpose() * x;
}

Vector3d Projection::operator()(const Vector3d& x_in_cam_m) const {
  const Vector3d x = view.view_from_cam * (x_in_cam_m - center_in_cam_m);
  const double shrink = Shrink(view, x.z());
  const Eigen::Vector2d flat = view.eye_in_view_m + shrink * (x.head<2>() - view.eye_in_view_m);
  Vector3d px;
  px << scale_px_per_m * flat + offset_px, scale_px_per_m * x.z();
  return px;
}

Eigen::Vector2d Projection::Flat(const Vector3d& x_in_cam_m) const {
  return (*this)(x_in_cam_m).head<2>();
}

Pose3 Projection::operator()(const Pose3& joints_in_cam_m) const {
  Pose3 px(3, joints_in_cam_m.cols());
  for (int j = 0; j < px.cols(); ++j) px.col(j) = (*this)(Vector3d(joints_in_cam_m.col(j)));
  return px;
}

}  // namespace poselift
