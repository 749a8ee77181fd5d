// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/camera_track.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace poselift {
namespace {

double Median(std::vector<double> values) {
  if (values.empty()) return kUnknown;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

CameraTrack FindCamera(const std::vector<const PersonPose*>& people) {
  CameraTrack camera;
  camera.has_depth = std::all_of(people.begin(), people.end(), [](const PersonPose* person) {
    return !person || person->pelvis_in_cam_m.allFinite();
  });
  std::vector<double> focals_px, x_px, y_px;
  for (const PersonPose* person : people) {
    if (!person || !std::isfinite(person->scale_px_per_m) || !person->translation_px.allFinite())
      continue;
    Eigen::Vector2d centre_px = person->translation_px;
    if (camera.has_depth) {
      centre_px -= person->scale_px_per_m * person->pelvis_in_cam_m.head<2>();
      focals_px.push_back(person->scale_px_per_m * person->pelvis_in_cam_m.z());
    }
    x_px.push_back(centre_px.x());
    y_px.push_back(centre_px.y());
  }
  camera.centre_px = {Median(std::move(x_px)), Median(std::move(y_px))};
  camera.focal_px = Median(std::move(focals_px));
  return camera;
}

}  // namespace poselift
