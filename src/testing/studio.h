// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Geometry>

#include "src/camera.h"
#include "src/motion.h"
#include "src/testing/body_renderer.h"

namespace poselift::testing {

// Where people walk and cameras stand: a motion made ready to be rendered.

// The motion at any time, its first frame at 0 s: between its frames their mixture
// (pose_between.h), before and after it its ends. Throws InputError without frames.
BodyRenderer::PoseAt PosesOver(Motion motion);

// The same walk on a treadmill: the path over the floor, smoothed over a second, is
// taken away, so that the body stays at one distance of a camera.
Motion OnTheSpot(Motion motion);

struct PlacedCamera {
  Camera camera;
  Eigen::Isometry3d cam_from_world;
};

// A webcam: 1280 x 720, a barrel of some pixels in the corners. A longer focal length is a zoom's.
Camera Webcam(double focal_px = 900.0);

// A level camera at the height of the pelvis, so far from where the pelvis is on
// average, on the side that it faces on average, turned by azimuth about the body,
// positive towards its left. Throws InputError without frames.
PlacedCamera CameraBefore(const Motion& motion, double distance_m, double azimuth_rad = 0.0,
                          const Camera& camera = Webcam());

}  // namespace poselift::testing
