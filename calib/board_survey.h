// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "calib/calibration_board.h"

namespace poselift {

// What pictures showed of a board, together: one that shows a smaller board shows a part of
// it, and one may seem to show a larger board; many that show the same other board say that
// the counts are wrong.
struct BoardSurvey {
  int num_found = 0;
  std::vector<BoardCounts> larger;     // of those found, what some look like a part of
  std::vector<BoardAbsence> absences;  // of the pictures without the board

  void AddFound(const BoardView& view);
};

// Why there is nothing to calibrate from, and what to do; empty when nothing is wrong with
// the board. Not visible, other counts and mirrored are different things.
std::string FlawOfBoard(const BoardFinder& finder, const BoardSurvey& survey);

// Of one picture, after others showed the board: "no board seen".
std::string Describe(const BoardFinder& finder, const BoardAbsence& absence);

}  // namespace poselift
