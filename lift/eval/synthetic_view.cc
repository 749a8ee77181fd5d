// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/eval/synthetic_view.h"

#include "lift/rotation.h"
#include "src/forward_kinematics.h"
#include "src/units.h"

namespace poselift {
namespace {

double Uniform(double low, double high, std::mt19937_64* rng) {
  return std::uniform_real_distribution<double>(low, high)(*rng);
}

Eigen::Matrix3d DrawCamera(const ViewRange& range, std::mt19937_64* rng) {
  const double yaw_deg = Uniform(-180.0, 180.0, rng);
  const double pitch_deg = Uniform(range.min_elevation_deg, range.max_elevation_deg, rng);
  const double roll_deg = Uniform(-range.max_roll_deg, range.max_roll_deg, rng);
  return CamFromBody(Eigen::Vector3d(pitch_deg, yaw_deg, roll_deg) * kRadFromDeg);
}

double HeightAtRest_m(const Skeleton& skeleton) {
  const Pose3 joints_m = JointPositions(skeleton, SkeletonPose::Rest(skeleton));
  return joints_m.row(1).maxCoeff() - joints_m.row(1).minCoeff();
}

}  // namespace

SyntheticView MakeView(const Pose3& joints_in_body_m, const Layout& layout, const ViewRange& range,
                       double noise_m, std::mt19937_64* rng) {
  constexpr double kScale_px_per_m = 200.0;
  std::normal_distribution<double> normal;
  SyntheticView view;
  view.joints_in_cam_m = DrawCamera(range, rng) * joints_in_body_m;
  for (const Landmark& landmark : layout.landmarks) {
    const Eigen::Vector3d x_in_cam_m = SumOfJoints(landmark.parts, view.joints_in_cam_m);
    const Eigen::Vector2d noise(normal(*rng), normal(*rng));
    view.labels.landmarks.push_back(
        {std::string(landmark.name), kScale_px_per_m * (x_in_cam_m.head<2>() + noise_m * noise)});
  }
  return view;
}

SequenceView MakeSequenceView(const Motion& motion, const Layout& layout,
                              const SequenceViewOptions& options, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  const double scale_px_per_m = options.body_height_px / HeightAtRest_m(motion.skeleton);
  SequenceView view;
  view.cam_from_world = DrawCamera(options.range, rng);
  for (const SkeletonPose& pose : motion.frames) {
    const Pose3 joints_in_cam_m = view.cam_from_world * JointPositions(motion.skeleton, pose);
    PersonLabels labels;
    for (const Landmark& landmark : layout.landmarks) {
      const Eigen::Vector2d x_px =
          scale_px_per_m * SumOfJoints(landmark.parts, joints_in_cam_m).head<2>();
      const double noise_x = normal(*rng), noise_y = normal(*rng);
      const bool missing = Uniform(0.0, 1.0, rng) < options.missing_share;
      labels.landmarks.push_back({std::string(landmark.name),
                                  x_px + options.noise_px * Eigen::Vector2d(noise_x, noise_y),
                                  missing ? LabelState::kAbsent : LabelState::kVisible});
    }
    view.joints_in_cam_m.push_back(joints_in_cam_m.colwise() - joints_in_cam_m.col(joint::kPelvis));
    view.labels.push_back(std::move(labels));
  }
  return view;
}

}  // namespace poselift
