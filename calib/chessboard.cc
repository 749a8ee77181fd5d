// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/chessboard.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "calib/saddle_points.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr int kFewestCorners = 3;  // a side; the finder knows no less
constexpr int kMostCorners = 50;
// On real photos both flags together find every whole board at exactly the counts asked for.
constexpr int kFlags = cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_NORMALIZE_IMAGE;

struct Corners {
  std::vector<cv::Point2f> px;  // row by row
  int rows = 0;
  int columns = 0;
};

// What the finder of OpenCV 4.6 says when it draws from this seed; it may throw.
Corners TryFindCorners(const cv::Mat& grey, const BoardCounts& counts, int flags, unsigned seed) {
  Corners corners;
  cv::Mat meta;
  cv::theRNG() = cv::RNG(seed);
  try {
    if (!cv::findChessboardCornersSB(grey, cv::Size(counts.columns, counts.rows), corners.px, flags,
                                     meta))
      return {};
  } catch (const cv::Exception&) {
    return {};
  }
  corners.rows = meta.rows;
  corners.columns = meta.cols;
  return static_cast<int>(corners.px.size()) == meta.rows * meta.cols ? corners : Corners{};
}

Eigen::Vector2d At(const Corners& corners, int row, int column) {
  const cv::Point2f& p = corners.px[static_cast<size_t>(row * corners.columns + column)];
  return {p.x, p.y};
}

// Each inner corner lies about midway between its neighbours, which perspective and the lens
// move by a small part of a square only.
bool IsGrid(const Corners& corners) {
  constexpr double kFarthest = 0.12;  // of the distance of the neighbours; a row left out: 0.17
  const auto is_midway = [&](int row, int column, int dr, int dc) {
    const Eigen::Vector2d a = At(corners, row - dr, column - dc);
    const Eigen::Vector2d b = At(corners, row + dr, column + dc);
    return (At(corners, row, column) - 0.5 * (a + b)).norm() <= kFarthest * (a - b).norm();
  };
  for (int row = 0; row < corners.rows; ++row)
    for (int column = 0; column < corners.columns; ++column) {
      if (row > 0 && row + 1 < corners.rows && !is_midway(row, column, 1, 0)) return false;
      if (column > 0 && column + 1 < corners.columns && !is_midway(row, column, 0, 1)) return false;
    }
  return true;
}

// The mean about a point; nothing outside of the picture.
std::optional<double> GreyAt(const cv::Mat& grey, const Eigen::Vector2d& x_px) {
  const cv::Rect about(cvRound(x_px.x()) - 1, cvRound(x_px.y()) - 1, 3, 3);
  if ((about & cv::Rect({}, grey.size())) != about) return std::nullopt;
  return cv::mean(grey(about))[0];
}

// 1 or -1 where four squares meet, of two greys in turn, 1 when those along the edges' sum are
// the lighter ones; else 0. The edges of the squares lead `across` and `down` from there.
int CornerSign(const cv::Mat& grey, const Eigen::Vector2d& x_px, const Eigen::Vector2d& across_px,
               const Eigen::Vector2d& down_px) {
  constexpr double kLeastContrast = 20.0, kMostUnlike = 0.5;
  const Eigen::Vector2d falling = 0.3 * (across_px + down_px), rising = 0.3 * (across_px - down_px);
  const auto a = GreyAt(grey, x_px + falling), b = GreyAt(grey, x_px - falling);
  const auto c = GreyAt(grey, x_px + rising), d = GreyAt(grey, x_px - rising);
  if (!a || !b || !c || !d) return 0;
  const double contrast = 0.5 * (*a + *b - *c - *d);
  const double unlike = std::max(std::abs(*a - *b), std::abs(*c - *d));
  if (std::abs(contrast) < kLeastContrast || unlike > kMostUnlike * std::abs(contrast)) return 0;
  return contrast > 0.0 ? 1 : -1;
}

// Where three in a row lead, in perspective.
Eigen::Vector2d Beyond(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       const Eigen::Vector2d& c) {
  return 3.0 * (c - b) + a;
}

// Most corners are where squares meet, dark and light in turn. The finder gives some boards rows
// that they do not have, and takes every second one, or aslant ones, of a larger board.
bool HasSquares(const cv::Mat& grey, const Corners& corners) {
  constexpr double kLeastShare = 0.75;
  int sum = 0;
  for (int row = 0; row < corners.rows; ++row)
    for (int column = 0; column < corners.columns; ++column) {
      const int above = std::max(0, row - 1), left = std::max(0, column - 1);
      const int sign = CornerSign(grey, At(corners, row, column),
                                  At(corners, row, left + 1) - At(corners, row, left),
                                  At(corners, above + 1, column) - At(corners, above, column));
      sum += (row + column) % 2 == 0 ? sign : -sign;
    }
  return std::abs(sum) >= kLeastShare * corners.rows * corners.columns;
}

// No corners when there is no such board. Of some draws the finder gives corners beyond the
// board (opencv#15712), of others the right ones.
Corners FindCorners(const cv::Mat& grey, const BoardCounts& counts, int flags) {
  constexpr unsigned kMostDraws = 6;
  for (unsigned seed = 1; seed <= kMostDraws; ++seed) {
    Corners corners = TryFindCorners(grey, counts, flags, seed);
    if (corners.px.empty() || (IsGrid(corners) && HasSquares(grey, corners))) return corners;
  }
  return {};
}

// Whether a camera that is no mirror sees rows and columns so.
bool IsRightHanded(const Corners& corners) {
  const Eigen::Vector2d along = At(corners, 0, corners.columns - 1) - At(corners, 0, 0);
  const Eigen::Vector2d down = At(corners, corners.rows - 1, 0) - At(corners, 0, 0);
  return along.x() * down.y() - along.y() * down.x() > 0.0;
}

// The finder gives either hand (opencv#22083).
void MakeRightHanded(Corners* corners) {
  if (IsRightHanded(*corners)) return;
  for (int row = 0; row < corners->rows; ++row) {
    const auto begin = corners->px.begin() + row * corners->columns;
    std::reverse(begin, begin + corners->columns);
  }
}

double LeastSpacing_px(const Corners& corners) {
  double least_px = std::numeric_limits<double>::infinity();
  for (int row = 0; row < corners.rows; ++row)
    for (int column = 0; column < corners.columns; ++column) {
      const Eigen::Vector2d x = At(corners, row, column);
      if (row > 0) least_px = std::min(least_px, (x - At(corners, row - 1, column)).norm());
      if (column > 0) least_px = std::min(least_px, (x - At(corners, row, column - 1)).norm());
    }
  return least_px;
}

// A larger window feels more of the light that falls unevenly on a real board.
void RefineCorners(const cv::Mat& grey, Corners* corners) {
  constexpr double kOfSpacing = 0.12;
  constexpr int kSmallest_px = 2, kLargest_px = 8;
  RefineSaddlePoints(grey,
                     std::clamp(static_cast<int>(kOfSpacing * LeastSpacing_px(*corners)),
                                kSmallest_px, kLargest_px),
                     &corners->px);
}

// Large pictures are not needed to count.
cv::Mat Reduced(const cv::Mat& grey) {
  constexpr double kPixels = 1e6;
  const double scale = std::sqrt(kPixels / static_cast<double>(grey.total()));
  if (scale >= 1.0) return grey;
  cv::Mat reduced;
  cv::resize(grey, reduced, {}, scale, scale, cv::INTER_AREA);
  return reduced;
}

// By a quarter.
Corners Turned(const Corners& corners) {
  Corners turned{{}, corners.columns, corners.rows};
  for (int row = 0; row < turned.rows; ++row)
    for (int column = 0; column < turned.columns; ++column)
      turned.px.push_back(
          corners.px[static_cast<size_t>((corners.rows - 1 - column) * corners.columns + row)]);
  return turned;
}

// One more row behind the last one, where the picture has it.
bool AddRow(const cv::Mat& grey, Corners* corners) {
  constexpr double kLeastShare = 0.8;
  const int last = corners->rows - 1;
  std::vector<cv::Point2f> row;
  int sum = 0;
  for (int column = 0; column < corners->columns; ++column) {
    const Eigen::Vector2d before = At(*corners, last, column);
    const Eigen::Vector2d x_px =
        Beyond(At(*corners, last - 2, column), At(*corners, last - 1, column), before);
    const int left = std::max(0, column - 1);
    const int sign = CornerSign(grey, x_px, At(*corners, last, left + 1) - At(*corners, last, left),
                                x_px - before);
    sum += column % 2 == 0 ? sign : -sign;
    row.emplace_back(x_px.x(), x_px.y());
  }
  if (std::abs(sum) < kLeastShare * corners->columns || last + 2 > kMostCorners) return false;
  corners->px.insert(corners->px.end(), row.begin(), row.end());
  ++corners->rows;
  RefineCorners(grey, corners);
  return true;
}

// All of the board of which a part has been found: in a larger board the finder takes a part for
// the one that is looked for.
BoardCounts WholeBoard(const cv::Mat& grey, Corners part) {
  for (bool grows = true; grows;) {
    grows = false;
    for (int side = 0; side < 4; ++side) {
      while (AddRow(grey, &part)) grows = true;
      part = Turned(part);
    }
  }
  return {part.rows, part.columns};
}

}  // namespace

std::string Chessboard::Validate() const {
  for (const int count : {rows, columns})
    if (count < kFewestCorners || count > kMostCorners)
      return fmt::format("found a chessboard of {} x {} inner corners, wanted {} to {} a side",
                         rows, columns, kFewestCorners, kMostCorners);
  if (!(square_m > 0.0 && square_m < 10.0))
    return fmt::format("found squares of {:g} m, wanted more than 0 and less than 10 m", square_m);
  return {};
}

CalibrationBoard Chessboard::Board() const {
  CalibrationBoard board;
  board.name = fmt::format("chessboard of {} x {} inner corners, squares of {:g} mm", rows, columns,
                           1e3 * square_m);
  board.corners_in_board_m.resize(2, rows * columns);
  for (int i = 0; i < rows * columns; ++i)
    board.corners_in_board_m.col(i) = square_m * Eigen::Vector2d(i % columns, i / columns);
  return board;
}

ChessboardFinder::ChessboardFinder(const Chessboard& chessboard) : chessboard_(chessboard) {
  if (const std::string flaw = chessboard.Validate(); !flaw.empty()) throw InputError(flaw);
  board_ = chessboard.Board();
}

BoardView ChessboardFinder::Find(const cv::Mat& grey) {
  Corners corners = FindCorners(grey, counts(), kFlags);
  if (corners.px.empty()) return {};
  MakeRightHanded(&corners);
  RefineCorners(grey, &corners);
  BoardView view;
  const BoardCounts whole = WholeBoard(grey, corners);
  if (whole != counts()) view.part_of = AsSaid(whole);
  view.ids.resize(corners.px.size());
  std::iota(view.ids.begin(), view.ids.end(), 0);
  view.corners_px.resize(2, static_cast<Eigen::Index>(corners.px.size()));
  for (Eigen::Index i = 0; i < view.corners_px.cols(); ++i)
    view.corners_px.col(i) << corners.px[static_cast<size_t>(i)].x,
        corners.px[static_cast<size_t>(i)].y;
  return view;
}

BoardAbsence ChessboardFinder::Explain(const cv::Mat& grey) {
  const cv::Mat reduced = Reduced(grey);
  std::vector<BoardCounts> candidates = seen_;
  // Fewer first: with a row hidden or outside of the picture that is what is left.
  for (const auto& [rows, columns] :
       {std::pair{-1, -1}, {0, -1}, {-1, 0}, {1, 1}, {0, 1}, {1, 0}, {-1, 1}, {1, -1}})
    candidates.push_back({chessboard_.rows + rows, chessboard_.columns + columns});
  for (const BoardCounts& candidate : candidates) {
    if (std::min(candidate.rows, candidate.columns) < kFewestCorners) continue;
    const Corners part = FindCorners(reduced, candidate, kFlags);
    if (part.px.empty()) continue;
    const BoardCounts whole = AsSaid(WholeBoard(reduced, part));
    if (whole == AsSaid(counts())) return {};
    if (std::find(seen_.begin(), seen_.end(), whole) == seen_.end()) seen_.push_back(whole);
    return {.seen = whole};
  }
  // Any board, of which it may see a part only.
  const Corners any = FindCorners(reduced, {kFewestCorners, kFewestCorners},
                                  cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_LARGER);
  if (any.px.empty()) return {};
  return {.seen = AsSaid(WholeBoard(reduced, any))};
}

BoardCounts ChessboardFinder::AsSaid(BoardCounts seen) const {
  if ((seen.rows > seen.columns) != (chessboard_.rows > chessboard_.columns))
    std::swap(seen.rows, seen.columns);
  return seen;
}

}  // namespace poselift
