// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/calibration_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "calib/calibration_start.h"
#include "src/units.h"

namespace poselift {
namespace {

constexpr double kEnoughTilt_rad = 20.0 / kDegFromRad;
constexpr double kEnoughSize = 0.45;  // of the picture's diagonal
constexpr int kEnoughViews = 10;
constexpr double kEnoughCells = 0.6;  // of a part of the picture

void CountCells(const BoardView& view, const Camera& camera, CalibrationCoverage* coverage) {
  constexpr int kCells = CalibrationCoverage::kCells;
  for (Eigen::Index i = 0; i < view.corners_px.cols(); ++i) {
    const auto cell = [&](double x_px, int size_px) {
      return std::clamp(static_cast<int>(kCells * (x_px + 0.5) / size_px), 0, kCells - 1);
    };
    ++coverage->corners(cell(view.corners_px(1, i), camera.height_px),
                        cell(view.corners_px(0, i), camera.width_px));
  }
}

// Of the board about the line of sight to its middle, so that a board at the picture's edge
// that faces the camera counts as not tilted.
void AddTilt(const CalibrationBoard& board, const Eigen::Isometry3d& cam_from_board,
             CalibrationCoverage* coverage) {
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  middle_m.head<2>() = board.corners_in_board_m.rowwise().mean();
  const Eigen::Vector3d sight = (cam_from_board * middle_m).normalized();
  Eigen::Vector3d normal = cam_from_board.linear().col(2);
  if (normal.dot(sight) < 0.0) normal = -normal;
  const Eigen::Vector3d in_sight =
      Eigen::Quaterniond::FromTwoVectors(sight, Eigen::Vector3d::UnitZ()) * normal;
  const double across_rad = std::atan2(in_sight.x(), in_sight.z());
  const double upwards_rad = std::atan2(in_sight.y(), in_sight.z());
  coverage->left_rad = std::max(coverage->left_rad, -across_rad);
  coverage->right_rad = std::max(coverage->right_rad, across_rad);
  coverage->up_rad = std::max(coverage->up_rad, -upwards_rad);
  coverage->down_rad = std::max(coverage->down_rad, upwards_rad);
}

// Where too few cells of a third by a third of the picture have corners, the emptiest first.
void AddPlaceHints(CalibrationCoverage* coverage) {
  constexpr std::array kPlaces = {"upper left", "top",        "upper right", "left",       "middle",
                                  "right",      "lower left", "bottom",      "lower right"};
  constexpr int kThird = CalibrationCoverage::kCells / 3;
  std::vector<std::pair<double, const char*>> empty;
  for (int place = 0; place < 9; ++place) {
    const auto cells =
        coverage->corners.block<kThird, kThird>(place / 3 * kThird, place % 3 * kThird);
    const double share =
        static_cast<double>((cells.array() > 0).count()) / static_cast<double>(cells.size());
    if (share < kEnoughCells) empty.emplace_back(share, kPlaces[static_cast<size_t>(place)]);
  }
  std::stable_sort(empty.begin(), empty.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [share, place] : empty)
    coverage->hints.push_back(fmt::format("hold the board to the {} of the picture", place));
}

void AddHints(CalibrationCoverage* coverage) {
  const std::array<std::pair<double, const char*>, 4> tilts = {
      {{coverage->left_rad, "its left edge nearer"},
       {coverage->right_rad, "its right edge nearer"},
       {coverage->up_rad, "its upper edge nearer"},
       {coverage->down_rad, "its lower edge nearer"}}};
  const auto least = std::min_element(tilts.begin(), tilts.end());
  if (least->first < kEnoughTilt_rad)
    coverage->hints.push_back(fmt::format("tilt the board by 30 to 45 degrees, {}", least->second));
  AddPlaceHints(coverage);
  if (coverage->largest_size < kEnoughSize)
    coverage->hints.push_back("hold the board nearer, so that it fills half of the picture");
  if (coverage->num_views < kEnoughViews)
    coverage->hints.push_back(
        fmt::format("show {} more views", kEnoughViews - coverage->num_views));
}

}  // namespace

CalibrationCoverage CoverageOf(const CalibrationBoard& board,
                               const std::vector<const BoardView*>& views,
                               const std::vector<Eigen::Isometry3d>& cam_from_board,
                               const Camera& camera) {
  CalibrationCoverage coverage;
  coverage.num_views = static_cast<int>(views.size());
  const double diagonal_px = std::hypot(camera.width_px, camera.height_px);
  for (size_t v = 0; v < views.size(); ++v) {
    const Eigen::Matrix2Xd& corners_px = views[v]->corners_px;
    CountCells(*views[v], camera, &coverage);
    AddTilt(board, cam_from_board[v], &coverage);
    const double size =
        (corners_px.rowwise().maxCoeff() - corners_px.rowwise().minCoeff()).norm() / diagonal_px;
    coverage.smallest_size = v == 0 ? size : std::min(coverage.smallest_size, size);
    coverage.largest_size = std::max(coverage.largest_size, size);
  }
  coverage.share = static_cast<double>((coverage.corners.array() > 0).count()) /
                   static_cast<double>(coverage.corners.size());
  AddHints(&coverage);
  return coverage;
}

CalibrationCoverage CoverageOf(const CalibrationBoard& board,
                               const std::vector<const BoardView*>& views, int width_px,
                               int height_px) {
  const double f_px = 1.1 * std::max(width_px, height_px);
  const Camera guess{width_px, height_px, f_px, f_px, 0.5 * width_px, 0.5 * height_px, {}};
  std::vector<const BoardView*> placed;
  std::vector<Eigen::Isometry3d> poses;
  for (const BoardView* view : views)
    if (const auto pose = FindBoardPose(board, *view, guess, 2.0)) {
      placed.push_back(view);
      poses.push_back(*pose);
    }
  return CoverageOf(board, placed, poses, guess);
}

}  // namespace poselift
