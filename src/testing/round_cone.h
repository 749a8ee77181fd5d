// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace poselift::testing {

// A limb: two spheres and the cone that touches both, stretched along the axes of
// its frame. With d a point's distance from `start` divided axis by axis by
// `stretch`, it is the spheres' convex hull in the space of d.
struct RoundCone {
  Eigen::Vector3d start_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d tip_m = Eigen::Vector3d::Zero();
  double start_radius_m = 0.0;
  double tip_radius_m = 0.0;
  Eigen::Vector3d stretch = Eigen::Vector3d::Ones();
};

// A ray through the origin of a frame, at depth z: z (x, y, 1).
using Ray = Eigen::Vector2f;

// A round cone made ready for many rays from one eye, the origin of `cam`.
class SeenRoundCone {
 public:
  SeenRoundCone(const RoundCone& cone, const Eigen::Isometry3d& cam_from_cone);

  // The depth z at which the ray enters, infinity where it does not. The eye is outside.
  float Depth_m(const Ray& ray) const;
  // Outward, of unit length, in cam.
  Eigen::Vector3f Normal(const Ray& ray, float depth_m) const;
  // A box in cam that holds it all.
  Eigen::AlignedBox3d Box() const { return box_; }

 private:
  // In the frame where it is not stretched, its axis is y and its start the origin.
  Eigen::Matrix3f local_from_cam_;
  Eigen::Vector3f eye_;
  float length_, start_radius_, tip_radius_;
  float sin_, cos_;  // of the angle between the axis and the cone's side
  float eye_term_;   // what of the quadratic equation does not change with the ray
  Eigen::AlignedBox3d box_;
};

}  // namespace poselift::testing
