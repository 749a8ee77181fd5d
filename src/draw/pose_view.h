// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "src/draw/scene.h"
#include "src/pose3.h"

namespace poselift {

// The picture that shows a 3D pose: four panels of one scale,
//   front          as the camera sees it
//   side           from the camera's right; the camera is at the left of the panel
//   above          the camera is at the bottom of the panel
//   three-quarter  from between front and the camera's right, and higher
// all but `above` in a mild perspective from a raised eye, so that the floor
// opens up; the plane through the middle of the pose is shown to scale. The
// floor is perpendicular to `up` through the pose's lowest joint, with lines
// every half metre (metre lines darker), the body's shadow straight below it
// and plumb lines from the pelvis, hands and feet. An arrow in each panel shows
// where the camera looks.
struct PoseViewInput {
  Pose3 joints_in_cam_m;                     // 3 x 23; x right, y down, z forward
  std::vector<Pose3> alternatives_in_cam_m;  // 3 x 23 each; thin and grey
  Eigen::Vector3d up_in_cam = -Eigen::Vector3d::UnitY();
  std::string title;
};

struct PoseViewOptions {
  int panel_px = 520;  // the picture is two panels wide, two high and a line of text

  std::string Validate() const;  // empty when all is well, else what is wrong
};

// 8-bit BGR. Joints that are not finite, or farther than 10 km, are left out.
// Throws std::invalid_argument on another number of joints, an `up` without
// direction, or options that do not validate.
cv::Mat DrawPoseView(const PoseViewInput& input, const PoseViewOptions& options = {});

// One panel, from around the body (OrbitView), its scale the same from everywhere: the
// panel is a little larger than the body, by `zoom` less.
struct PoseOrbit {
  double yaw_rad = 0.7, pitch_rad = 0.35;
  double zoom = 1.0;
};
// stage: of a pose that keeps the middle, the size and the floor of the picture while the pose in
// it changes, as under a mouse that drags.
cv::Mat DrawPoseFrom(const PoseViewInput& input, const PoseOrbit& orbit, int side_px,
                     const Scene* stage = nullptr);
// The stage of a pose, and where DrawPoseFrom shows the points on it.
Scene PoseStage(const PoseViewInput& input);
Projection PoseProjection(const Scene& stage, const PoseOrbit& orbit, int side_px);

}  // namespace poselift
