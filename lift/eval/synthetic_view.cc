// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/eval/synthetic_view.h"

#include "lift/rotation.h"
#include "src/units.h"

namespace poselift {

SyntheticView MakeView(const Pose3& joints_in_body_m, const Layout& layout, const ViewRange& range,
                       double noise_m, std::mt19937_64* rng) {
  constexpr double kScale_px_per_m = 200.0;
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(*rng);
  };
  std::normal_distribution<double> normal;
  const double yaw_deg = uniform(-180.0, 180.0);
  const double pitch_deg = uniform(range.min_elevation_deg, range.max_elevation_deg);
  const double roll_deg = uniform(-range.max_roll_deg, range.max_roll_deg);
  const Eigen::Vector3d tau_rad = Eigen::Vector3d(pitch_deg, yaw_deg, roll_deg) * kRadFromDeg;

  SyntheticView view;
  view.joints_in_cam_m = CamFromBody(tau_rad) * joints_in_body_m;
  for (const Landmark& landmark : layout.landmarks) {
    const Eigen::Vector3d x_in_cam_m = SumOfJoints(landmark.parts, view.joints_in_cam_m);
    const Eigen::Vector2d noise(normal(*rng), normal(*rng));
    view.labels.landmarks.push_back(
        {std::string(landmark.name), kScale_px_per_m * (x_in_cam_m.head<2>() + noise_m * noise)});
  }
  return view;
}

}  // namespace poselift
