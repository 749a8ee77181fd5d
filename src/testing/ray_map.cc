// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/ray_map.h"

namespace poselift::testing {

RayMap::RayMap(const Camera& camera) : stride_(camera.width_px + 2) {
  rays_.reserve(static_cast<size_t>(stride_) * (camera.height_px + 2));
  for (int y = -1; y <= camera.height_px; ++y)
    for (int x = -1; x <= camera.width_px; ++x)
      rays_.push_back(camera.Undistort({x, y}).head<2>().cast<float>());
}

}  // namespace poselift::testing
