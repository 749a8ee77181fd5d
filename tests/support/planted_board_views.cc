// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/planted_board_views.h"

namespace poselift::testing {
namespace {

double Uniform(double from, double to, std::mt19937_64* rng) {
  return std::uniform_real_distribution<double>(from, to)(*rng);
}

Eigen::Isometry3d RandomPose(const CalibrationBoard& board, const Camera& camera,
                             double largest_tilt_rad, std::mt19937_64* rng) {
  const Eigen::Vector2d low_m = board.corners_in_board_m.rowwise().minCoeff();
  const Eigen::Vector2d high_m = board.corners_in_board_m.rowwise().maxCoeff();
  const Eigen::Vector2d middle_m = 0.5 * (low_m + high_m);
  const double share = Uniform(0.35, 0.9, rng);  // of the picture's smaller side
  const double depth_m = camera.fx_px * (high_m - low_m).norm() /
                         (share * std::min(camera.width_px, camera.height_px));
  const Eigen::Vector2d at_px(Uniform(0.15, 0.85, rng) * camera.width_px,
                              Uniform(0.15, 0.85, rng) * camera.height_px);
  const double direction_rad = Uniform(-M_PI, M_PI, rng);
  const Eigen::Vector3d axis(std::cos(direction_rad), std::sin(direction_rad), 0.0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(Uniform(0.0, largest_tilt_rad, rng), axis) *
                   Eigen::AngleAxisd(Uniform(-0.6, 0.6, rng), Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  const Eigen::Vector3d centre_in_cam_m(depth_m * (at_px.x() - camera.cx_px) / camera.fx_px,
                                        depth_m * (at_px.y() - camera.cy_px) / camera.fy_px,
                                        depth_m);
  pose.translation() =
      centre_in_cam_m - pose.linear() * Eigen::Vector3d(middle_m.x(), middle_m.y(), 0.0);
  return pose;
}

BoardView See(const CalibrationBoard& board, const Camera& camera, const Eigen::Isometry3d& pose,
              double noise_px, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  BoardView view;
  view.corners_px.resize(2, board.num_corners());
  for (int id = 0; id < board.num_corners(); ++id) {
    const Eigen::Vector3d corner_m(board.corners_in_board_m(0, id), board.corners_in_board_m(1, id),
                                   0.0);
    const Eigen::Vector2d seen_px = camera.Project(pose * corner_m);
    if (!(seen_px.x() > 0 && seen_px.y() > 0 && seen_px.x() < camera.width_px - 1 &&
          seen_px.y() < camera.height_px - 1))
      continue;
    view.corners_px.col(static_cast<Eigen::Index>(view.ids.size()))
        << seen_px.x() + noise_px * normal(*rng),
        seen_px.y() + noise_px * normal(*rng);
    view.ids.push_back(id);
  }
  view.corners_px.conservativeResize(2, static_cast<Eigen::Index>(view.ids.size()));
  return view;
}

}  // namespace

PlantedViews PlantBoardViews(const CalibrationBoard& board, const Camera& camera,
                             const PlantedViewsOptions& options, std::mt19937_64* rng) {
  PlantedViews planted;
  while (static_cast<int>(planted.views.size()) < options.num_views) {
    const Eigen::Isometry3d pose = RandomPose(board, camera, options.largest_tilt_rad, rng);
    const BoardView view = See(board, camera, pose, options.noise_px, rng);
    const int fewest = options.may_leave_picture ? board.num_corners() / 4 : board.num_corners();
    if (static_cast<int>(view.ids.size()) < fewest) continue;
    planted.views.push_back(view);
    planted.cam_from_board.push_back(pose);
  }
  return planted;
}

}  // namespace poselift::testing
