// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/april_grid_finder.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
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
  if (tags.size() < kFewestTags + 1) return std::nullopt;
  const int highest = tags.back().id - grid.first_id;
  for (int columns = 1; columns <= std::max(grid.columns, highest) + 1; ++columns) {
    AprilGrid other = grid;
    other.columns = columns;
    other.rows = highest / columns + 1;
    if (other.Validate().empty() && LieAsOn(other, tags)) return {{other.rows, other.columns}};
  }
  return std::nullopt;
}

// Those before it cannot be on it, whatever its rows and columns are.
std::vector<TagDetection> FromFirstOf(const AprilGrid& grid, std::vector<TagDetection> tags) {
  std::erase_if(tags, [&](const TagDetection& tag) { return tag.id < grid.first_id; });
  return tags;
}

TagRange RangeOf(const std::string& family, const std::vector<TagDetection>& tags) {
  return {family, tags.front().id, tags.back().id};
}

}  // namespace

CalibrationBoard BoardOf(const AprilGrid& grid) {
  CalibrationBoard board;
  board.name =
      fmt::format("{} x {} tags of {}, ids {} to {}, {:g} mm", grid.rows, grid.columns, grid.family,
                  grid.first_id, grid.first_id + grid.num_tags() - 1, 1e3 * grid.tag_size_m);
  board.corners_in_board_m.resize(2, 4 * grid.num_tags());
  const Eigen::Matrix<double, 3, 4> around_m = TagCorners_m(grid.tag_size_m);
  const Eigen::Vector2d middle_m = Eigen::Vector2d::Constant(0.5 * grid.tag_size_m);
  for (int tag = 0; tag < grid.num_tags(); ++tag)
    board.corners_in_board_m.middleCols<4>(4 * static_cast<Eigen::Index>(tag)) =
        around_m.topRows<2>().colwise() + (grid.TopLeft_m(grid.first_id + tag) + middle_m);
  return board;
}

AprilGridFinder::AprilGridFinder(const AprilGrid& grid)
    : grid_(Checked(grid)), board_(BoardOf(grid_)), family_(grid_.family), detector_(family_) {}

BoardView AprilGridFinder::Find(const cv::Mat& grey) {
  const std::vector<TagDetection> all = detector_.Detect(grey);
  std::vector<TagDetection> tags = all;
  std::erase_if(tags, [&](const TagDetection& tag) { return !grid_.Has(tag.id); });
  if (tags.size() < kFewestTags || !LieAsOn(grid_, tags)) return {};
  BoardView view = ViewOf(grid_, tags);
  if (all.back().id >= grid_.first_id + grid_.num_tags())
    view.part_of = CountsSeen(grid_, FromFirstOf(grid_, all));
  return view;
}

BoardAbsence AprilGridFinder::Explain(const cv::Mat& grey) {
  const std::vector<TagDetection> tags = detector_.Detect(grey);
  if (tags.size() < kFewestTags) {
    cv::Mat mirrored;
    cv::flip(grey, mirrored, 1);
    if (detector_.Detect(mirrored).size() >= kFewestTags) return {.is_mirrored = true};
    return {.others = OtherFamily(grey)};
  }
  if (const auto seen = CountsSeen(grid_, FromFirstOf(grid_, tags))) return {.seen = seen};
  return {.others = RangeOf(grid_.family, tags)};
}

std::optional<TagRange> AprilGridFinder::OtherFamily(const cv::Mat& grey) {
  std::optional<TagRange> most;
  size_t num_most = kFewestTags - 1;
  for (const std::string& name : other_families_) {
    const std::vector<TagDetection> tags = TagDetector(TagFamily(name)).Detect(grey);
    if (tags.size() <= num_most) continue;
    num_most = tags.size();
    most = RangeOf(name, tags);
  }
  // All families take long: the next pictures show the same one.
  if (most) other_families_ = {most->family};
  return most;
}

}  // namespace poselift
