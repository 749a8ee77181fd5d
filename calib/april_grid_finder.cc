// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/april_grid_finder.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <opencv2/core.hpp>
#include <optional>

#include "calib/calibration_start.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr size_t kFewestTags = 2;

AprilGrid Checked(const AprilGrid& grid) {
  if (const std::string flaw = grid.Validate(); !flaw.empty()) throw InputError(flaw);
  return grid;
}

std::vector<int> IdsOf(const AprilGrid& grid) {
  std::vector<int> ids(static_cast<size_t>(grid.num_tags()));
  std::iota(ids.begin(), ids.end(), grid.first_id);
  return ids;
}

// All tags are the grid's.
BoardView ViewOf(const AprilGrid& grid, const std::vector<TagDetection>& tags) {
  BoardView view;
  view.corners_px.resize(2, 4 * static_cast<Eigen::Index>(tags.size()));
  for (const TagDetection& tag : tags)
    for (int c = 0; c < 4; ++c) {
      view.corners_px.col(static_cast<Eigen::Index>(view.ids.size())) = tag.corners_px.col(c);
      view.ids.push_back(4 * (tag.id - grid.first_id) + c);
    }
  return view;
}

// How far the corners are from those of the grid in perspective, rms, over a tag's edge in the
// picture. A lens bends lines by a small part of an edge; a wrong place is a whole edge off.
std::optional<double> Misfit(const AprilGrid& grid, const std::vector<TagDetection>& tags) {
  const CalibrationBoard board = BoardOf(grid);
  const BoardView view = ViewOf(grid, tags);
  const auto px_from_board = BoardHomography(board, view);
  if (!px_from_board) return std::nullopt;
  double sum_px2 = 0.0, edges_px = 0.0;
  for (Eigen::Index i = 0; i < view.corners_px.cols(); ++i) {
    const Eigen::Vector2d on_board_m =
        board.corners_in_board_m.col(view.ids[static_cast<size_t>(i)]);
    const Eigen::Vector2d expected_px = (*px_from_board * on_board_m.homogeneous()).hnormalized();
    sum_px2 += (view.corners_px.col(i) - expected_px).squaredNorm();
  }
  for (const TagDetection& tag : tags)
    edges_px += (tag.corners_px.col(0) - tag.corners_px.col(2)).norm() / std::sqrt(2.0);
  return std::sqrt(sum_px2 / static_cast<double>(view.corners_px.cols())) /
         (edges_px / static_cast<double>(tags.size()));
}

bool LieAsOn(const AprilGrid& grid, const std::vector<TagDetection>& tags) {
  constexpr double kLargestMisfit = 0.2;
  const auto misfit = Misfit(grid, tags);
  return misfit && *misfit < kLargestMisfit;
}

// The columns that put the tags where they are. Which rows there are, no more is known than
// the highest that is seen.
std::optional<BoardCounts> CountsSeen(const AprilGrid& grid,
                                      const std::vector<TagDetection>& tags) {
  const int highest = tags.back().id - grid.first_id;
  for (int columns = 1; columns <= std::max(grid.columns, highest) + 1; ++columns) {
    AprilGrid other = grid;
    other.columns = columns;
    other.rows = highest / columns + 1;
    if (other.Validate().empty() && LieAsOn(other, tags)) return {{other.rows, other.columns}};
  }
  return std::nullopt;
}

}  // namespace

CalibrationBoard BoardOf(const AprilGrid& grid) {
  CalibrationBoard board;
  board.name = fmt::format("{} x {} tags of {}, {:g} mm", grid.rows, grid.columns, grid.family,
                           1e3 * grid.tag_size_m);
  board.corners_in_board_m.resize(2, 4 * grid.num_tags());
  const Eigen::Matrix<double, 3, 4> around_m = TagCorners_m(grid.tag_size_m);
  const Eigen::Vector2d middle_m = Eigen::Vector2d::Constant(0.5 * grid.tag_size_m);
  for (int tag = 0; tag < grid.num_tags(); ++tag)
    board.corners_in_board_m.middleCols<4>(4 * static_cast<Eigen::Index>(tag)) =
        around_m.topRows<2>().colwise() + (grid.TopLeft_m(grid.first_id + tag) + middle_m);
  return board;
}

AprilGridFinder::AprilGridFinder(const AprilGrid& grid)
    : grid_(Checked(grid)),
      board_(BoardOf(grid_)),
      family_(grid_.family),
      detector_(family_, {.known_ids = IdsOf(grid_)}) {}

BoardView AprilGridFinder::Find(const cv::Mat& grey) {
  const std::vector<TagDetection> tags = detector_.Detect(grey);
  if (tags.size() < kFewestTags || !LieAsOn(grid_, tags)) return {};
  return ViewOf(grid_, tags);
}

BoardAbsence AprilGridFinder::Explain(const cv::Mat& grey) {
  TagDetector all(family_);
  std::vector<TagDetection> tags = all.Detect(grey);
  if (tags.empty()) {
    cv::Mat mirrored;
    cv::flip(grey, mirrored, 1);
    return {.is_mirrored = all.Detect(mirrored).size() >= kFewestTags};
  }
  std::erase_if(tags, [&](const TagDetection& tag) { return tag.id < grid_.first_id; });
  if (tags.size() < kFewestTags + 1) return {};
  return {.seen = CountsSeen(grid_, tags)};
}

}  // namespace poselift
