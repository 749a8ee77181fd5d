// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/board_picture.h"

#include <cmath>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "calib/tag_family.h"

namespace poselift::testing {
namespace {

constexpr double kWall = 110.0, kWhite = 235.0, kBlack = 25.0;

// Rays through the corners of all pixels.
std::vector<Eigen::Vector2d> CornerRays(const Camera& camera) {
  std::vector<Eigen::Vector2d> rays;
  for (int y = 0; y <= camera.height_px; ++y)
    for (int x = 0; x <= camera.width_px; ++x)
      rays.push_back(camera.Undistort({x - 0.5, y - 0.5}).head<2>());
  return rays;
}

}  // namespace

BoardPrint PrintOf(const Chessboard& chessboard) {
  return [chessboard](const Eigen::Vector2d& x_m) {
    // In squares from the outer corner of the first square.
    const Eigen::Vector2d x = x_m / chessboard.square_m + Eigen::Vector2d::Ones();
    const double columns = chessboard.columns + 1, rows = chessboard.rows + 1;
    if (x.x() < -1 || x.y() < -1 || x.x() > columns + 1 || x.y() > rows + 1) return kWall;
    if (x.x() < 0 || x.y() < 0 || x.x() > columns || x.y() > rows) return kWhite;
    const auto column = static_cast<int>(x.x()), row = static_cast<int>(x.y());
    return (row + column) % 2 == 0 ? kBlack : kWhite;
  };
}

BoardPrint PrintOf(const AprilGrid& grid) {
  const TagFamily family(grid.family);
  auto images = std::make_shared<std::map<int, cv::Mat>>();
  for (int id = grid.first_id; id < grid.first_id + grid.num_tags(); ++id)
    (*images)[id] = family.Image(id);
  const double cell_m = grid.tag_size_m / family.cells_of_size();
  const int num_cells = family.cells();
  return [=](const Eigen::Vector2d& x_m) {
    const double rim_m = 0.5 * grid.tag_size_m;
    if (x_m.x() < -rim_m || x_m.y() < -rim_m || x_m.x() > grid.Width_m() + rim_m ||
        x_m.y() > grid.Height_m() + rim_m)
      return kWall;
    // Cells begin outside of the square between the borders.
    const double outside_m = 0.5 * (num_cells - family.cells_of_size()) * cell_m;
    const double gap_m = grid.Pitch_m() - grid.tag_size_m;
    const auto column = static_cast<int>(std::floor((x_m.x() + 0.5 * gap_m) / grid.Pitch_m()));
    const auto row = static_cast<int>(std::floor((x_m.y() + 0.5 * gap_m) / grid.Pitch_m()));
    if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) return kWhite;
    const int id = grid.first_id + (grid.rows - 1 - row) * grid.columns + column;
    const Eigen::Vector2d in_cells = (x_m - Eigen::Vector2d(column, row) * grid.Pitch_m() +
                                      Eigen::Vector2d::Constant(outside_m)) /
                                     cell_m;
    const auto u = static_cast<int>(std::floor(in_cells.x()));
    const auto v = static_cast<int>(std::floor(in_cells.y()));
    if (u < 0 || v < 0 || u >= num_cells || v >= num_cells) return kWhite;
    return images->at(id).at<uchar>(v, u) > 127 ? kWhite : kBlack;
  };
}

cv::Mat RenderBoard(const BoardPrint& print, const Camera& camera,
                    const Eigen::Isometry3d& cam_from_board) {
  constexpr int kSamples = 32;  // of a pixel, no two in one row or column
  const std::vector<Eigen::Vector2d> rays = CornerRays(camera);
  const Eigen::Isometry3d board_from_cam = cam_from_board.inverse();
  const auto level_of = [&](const Eigen::Vector2d& ray) {
    const Eigen::Vector3d direction = board_from_cam.linear() * ray.homogeneous();
    const double depth = -board_from_cam.translation().z() / direction.z();
    if (!(depth > 0)) return kWall;
    return print((board_from_cam.translation() + depth * direction).head<2>());
  };
  cv::Mat picture(camera.height_px, camera.width_px, CV_8UC1);
  const auto stride = static_cast<size_t>(camera.width_px) + 1;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const size_t corner = static_cast<size_t>(y) * stride + static_cast<size_t>(x);
      double sum = 0.0;
      for (int i = 0; i < kSamples; ++i) {
        const double a = (i + 0.5) / kSamples, b = (i * 13 % kSamples + 0.5) / kSamples;
        sum += level_of((1 - b) * ((1 - a) * rays[corner] + a * rays[corner + 1]) +
                        b * ((1 - a) * rays[corner + stride] + a * rays[corner + stride + 1]));
      }
      picture.at<uchar>(y, x) = cv::saturate_cast<uchar>(sum / kSamples);
    }
  return picture;
}

}  // namespace poselift::testing
