// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace poselift {

// A flat board whose corners a camera finds. Its frame, `board`: x to the right, y down as
// it is printed, z into the paper, so that a camera before an upright board has its axes.
struct CalibrationBoard {
  std::string name;                     // "chessboard of 4 x 7 inner corners, squares of 60 mm"
  Eigen::Matrix2Xd corners_in_board_m;  // by corner id; z = 0

  int num_corners() const { return static_cast<int>(corners_in_board_m.cols()); }
};

struct BoardCounts {
  int rows = 0;
  int columns = 0;
  bool operator==(const BoardCounts&) const = default;
};

// What a picture shows of a board.
struct BoardView {
  std::vector<int> ids;                // of corners, increasing
  Eigen::Matrix2Xd corners_px;         // of each id; integer = pixel centre
  std::optional<BoardCounts> part_of;  // the larger board that it looks like a part of

  bool empty() const { return ids.empty(); }
};

// Tags of a family, by their lowest and highest id.
struct TagRange {
  std::string family;
  int first_id = 0;
  int last_id = 0;
};

// Why a picture shows no board: another one is seen, or a mirrored one, or tags that are not
// the board's, or none of these.
struct BoardAbsence {
  std::optional<BoardCounts> seen;
  bool is_mirrored = false;
  std::optional<TagRange> others;
};

// Finds one kind of board in pictures.
class BoardFinder {
 public:
  virtual ~BoardFinder() = default;

  virtual const CalibrationBoard& board() const = 0;
  // What the counts count, for messages: "inner corners", "tags".
  virtual BoardCounts counts() const = 0;
  virtual std::string counted() const = 0;

  // grey: 8 bits. An empty view when the board is not there.
  virtual BoardView Find(const cv::Mat& grey) = 0;
  // Where Find found nothing. Takes longer.
  virtual BoardAbsence Explain(const cv::Mat& grey) = 0;
};

}  // namespace poselift
