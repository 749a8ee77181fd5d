// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "src/pose3.h"

namespace poselift {

// A pose on its floor, ready to be looked at from anywhere. Directions are unit
// vectors in cam; right, -up and away are a right-handed frame like cam's own,
// levelled: away is where the camera looks, along the floor.
struct Scene {
  Pose3 joints_in_cam_m;  // joints that cannot be drawn are NaN
  std::vector<Pose3> others_in_cam_m;
  Eigen::Vector3d up, right, away;
  Eigen::Vector3d center_in_cam_m;  // of the box around all poses
  double radius_m;                  // no joint is farther from the center; at least 0.3
  Eigen::Vector3d base_in_cam_m;    // the point of the floor below the pelvis
  double grid_step_m;               // 0.5; more for poses far beyond a body's size

  Eigen::Vector3d OnFloor(const Eigen::Vector3d& x_in_cam_m) const;
  Pose3 Shadow() const;  // each joint on the floor below it
};

// up_in_cam has any length but zero.
Scene MakeScene(const Pose3& joints_in_cam_m, const std::vector<Pose3>& others_in_cam_m,
                const Eigen::Vector3d& up_in_cam);

// A way of looking at the scene. In its frame x is right, y down and z away
// from the viewer, with the scene's center at the origin.
struct View {
  std::string title;
  Eigen::Matrix3d view_from_cam;
  // The viewer is this far before the plane z = 0, which is shown to scale;
  // 0 for infinitely far: a parallel projection.
  double eye_distance_m = 0.0;
  Eigen::Vector2d eye_in_view_m = Eigen::Vector2d::Zero();  // where on that plane
};

// front, side, above, three-quarter.
std::vector<View> StandardViews(const Scene& scene);

// From around the body: yaw 0 from where the camera is, a quarter turn from its right; pitch
// upwards. Three-quarter is 40 and 20 degrees.
View OrbitView(const Scene& scene, double yaw_rad, double pitch_rad);

// x and y in pixels, z the depth in pixels:
//   s = d / (d + z),   px = scale (eye + s (x - eye)) + offset
struct Projection {
  View view;
  Eigen::Vector3d center_in_cam_m;
  double scale_px_per_m = 1.0;
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& x_in_cam_m) const;
  Eigen::Vector2d Flat(const Eigen::Vector3d& x_in_cam_m) const;
  Pose3 operator()(const Pose3& joints_in_cam_m) const;
  // The point that is seen there and is as far away as another one.
  Eigen::Vector3d InCam(const Eigen::Vector2d& x_px, const Eigen::Vector3d& as_far_in_cam_m) const;
};

}  // namespace poselift
