// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "calib/calibration_board.h"

namespace poselift {

// A chessboard, counted by its inner corners: those where four squares meet.
struct Chessboard {
  int rows = 0;
  int columns = 0;
  double square_m = 0.0;

  // What is wrong, with its value; empty when nothing is.
  std::string Validate() const;
  // The corners row by row; origin at the first.
  CalibrationBoard Board() const;
};

// By cv::findChessboardCornersSB (Duda and Frese 2018), which needs the whole board in the
// picture. A board and the same turned by a quarter are one board, so rows and columns may
// be exchanged.
class ChessboardFinder : public BoardFinder {
 public:
  // Throws InputError for a board that is not valid.
  explicit ChessboardFinder(const Chessboard& chessboard);

  const CalibrationBoard& board() const override { return board_; }
  BoardCounts counts() const override { return {chessboard_.rows, chessboard_.columns}; }
  std::string counted() const override { return "inner corners"; }

  BoardView Find(const cv::Mat& grey) override;
  // Looks for a row or a column more or less, then for any chessboard; counts seen once are
  // tried first in the next pictures.
  BoardAbsence Explain(const cv::Mat& grey) override;

 private:
  // The lesser count first, or last, as it is said.
  BoardCounts AsSaid(BoardCounts seen) const;

  Chessboard chessboard_;
  CalibrationBoard board_;
  std::vector<BoardCounts> seen_;
};

}  // namespace poselift
