// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>

#include "lift/weak_camera.h"
#include "src/observation.h"
#include "src/pose3.h"

namespace poselift {

// True perspective for a lifter that knows weak perspective alone (POSIT,
// DeMenthon and Davis 1995). A pinhole camera of focal length f and centre c
// sees point i, z_i behind the pelvis whose depth is Z, at
//   x_i = c + f X_i / (Z + z_i),   so that
//   c + (1 + z_i / Z) (x_i - c) = c + f X_i / Z
// is what a weak-perspective camera of scale s = f / Z would have shown. With
// the z_i of one lift the next is closer; where nothing changes any more, the
// pose explains the picture in true perspective.

// The pelvis before the pinhole camera: ((t - c) / s, f / s), metres.
Eigen::Vector3d PelvisInCam_m(const Pinhole& pinhole, const WeakCamera& camera);

// Where the pinhole camera sees points (3 x n, pelvis at the origin, cam axes).
// None is brought nearer to the camera than a tenth of the pelvis's depth.
Eigen::Matrix2Xd ProjectInPerspective(const Pinhole& pinhole, const WeakCamera& camera,
                                      const Eigen::Matrix3Xd& x_in_cam_m);

// The 2D points, their sigmas too, as weak perspective would show them; without
// a pinhole. All else stays.
Observation AsWeakPerspective(const Observation& seen, const Pose3& joints_in_cam_m,
                              const WeakCamera& camera);

}  // namespace poselift
