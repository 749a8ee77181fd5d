// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/perspective.h"

#include <algorithm>

namespace poselift {
namespace {

// (Z + z) / Z: how much farther than the pelvis.
double RelativeDepth(const Pinhole& pinhole, const WeakCamera& camera, double z_m) {
  return std::max(0.1, 1.0 + z_m * camera.scale_px_per_m / pinhole.focal_px);
}

}  // namespace

Eigen::Vector3d PelvisInCam_m(const Pinhole& pinhole, const WeakCamera& camera) {
  Eigen::Vector3d pelvis_px;
  pelvis_px << camera.translation_px - pinhole.centre_px, pinhole.focal_px;
  return pelvis_px / camera.scale_px_per_m;
}

Eigen::Matrix2Xd ProjectInPerspective(const Pinhole& pinhole, const WeakCamera& camera,
                                      const Eigen::Matrix3Xd& x_in_cam_m) {
  Eigen::Matrix2Xd x_px = camera.Project(x_in_cam_m).colwise() - pinhole.centre_px;
  for (Eigen::Index i = 0; i < x_px.cols(); ++i)
    x_px.col(i) /= RelativeDepth(pinhole, camera, x_in_cam_m(2, i));
  return x_px.colwise() + pinhole.centre_px;
}

Observation AsWeakPerspective(const Observation& seen, const Pose3& joints_in_cam_m,
                              const WeakCamera& camera) {
  Observation weak = seen;
  weak.pinhole.reset();
  for (ObservedPoint& point : weak.points) {
    if (point.kind != ObservedPoint::Kind::k2D) continue;
    const double z_m = SumOfJoints(point.parts, joints_in_cam_m).z();
    const double factor = RelativeDepth(*seen.pinhole, camera, z_m);
    point.x.head<2>() =
        seen.pinhole->centre_px + factor * (point.x.head<2>() - seen.pinhole->centre_px);
    point.sigma *= factor;
  }
  return weak;
}

}  // namespace poselift
