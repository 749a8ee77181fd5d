// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "src/camera.h"
#include "src/testing/round_cone.h"

namespace poselift::testing {

// The ray that each pixel of a camera sees (Camera::Undistort), and those beside its
// centre to first order: over half a pixel a lens bends by less than 1e-4 px. Where the
// lens shows nothing they are NaN and meet nothing.
class RayMap {
 public:
  explicit RayMap(const Camera& camera);

  // step_px: from the pixel's centre.
  Ray At(int x, int y, const Eigen::Vector2f& step_px) const {
    const Ray* here = &rays_[static_cast<size_t>(y + 1) * stride_ + x + 1];
    return *here + 0.5f * (step_px.x() * (here[1] - here[-1]) +
                           step_px.y() * (here[stride_] - here[-stride_]));
  }

 private:
  int stride_;  // a border of one pixel around the picture
  std::vector<Ray> rays_;
};

}  // namespace poselift::testing
