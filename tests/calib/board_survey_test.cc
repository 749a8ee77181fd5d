// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sentences. Checked: each cause has its own.
#include "calib/board_survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/chessboard.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

BoardAbsence Seen(int rows, int columns) { return {.seen = BoardCounts{rows, columns}}; }

TEST(BoardSurveyTest, EachCauseHasItsOwnSentence) {
  ChessboardFinder finder({5, 8, 0.03});
  EXPECT_EQ(FlawOfBoard(finder, {.num_found = 3, .absences = {Seen(5, 7), {}}}), "");
  EXPECT_THAT(FlawOfBoard(finder, {.absences = {{}, {}}}),
              HasSubstr("no board is visible in any of 2 pictures"));
  EXPECT_THAT(FlawOfBoard(finder, {.absences = {Seen(4, 7), Seen(4, 7), {}}}),
              HasSubstr("I see 4 x 7 inner corners in 2 of 3 pictures, you said 5 x 8; count the "
                        "inner corners"));
  EXPECT_THAT(FlawOfBoard(finder, {.absences = {Seen(6, 9)}}),
              HasSubstr("I see 6 x 9 inner corners in 1 of 1 pictures, you said 5 x 8"));
  EXPECT_THAT(FlawOfBoard(finder, {.absences = {Seen(5, 7)}}), HasSubstr("hidden or outside"));
  EXPECT_THAT(FlawOfBoard(finder, {.num_found = 1,
                                   .absences = {{.is_mirrored = true}, {.is_mirrored = true}}}),
              HasSubstr("mirrored"));
}

TEST(BoardSurveyTest, OneFoundByChanceDoesNotOutweighManyOthers) {
  ChessboardFinder finder({3, 6, 0.03});
  const BoardSurvey survey{.num_found = 1, .absences = {Seen(4, 7), Seen(4, 7), Seen(4, 7)}};
  EXPECT_THAT(FlawOfBoard(finder, survey), HasSubstr("I see 4 x 7 inner corners in 3 of 4"));
}

TEST(BoardSurveyTest, PartsOfALargerBoardAreToldByMostOfThePictures) {
  ChessboardFinder finder({3, 6, 0.03});
  BoardView as_said, part;
  part.part_of = {4, 7};
  BoardSurvey survey;
  survey.AddFound(as_said);
  survey.AddFound(as_said);
  survey.AddFound(part);  // may be by chance
  EXPECT_EQ(FlawOfBoard(finder, survey), "");
  survey.AddFound(part);
  survey.absences.push_back(Seen(4, 7));
  EXPECT_THAT(FlawOfBoard(finder, survey),
              HasSubstr("I see 4 x 7 inner corners in 3 of 5 pictures, you said 3 x 6; say 4 x 7"));
}

TEST(BoardSurveyTest, APictureIsDescribedByWhatItShows) {
  ChessboardFinder finder({5, 8, 0.03});
  EXPECT_EQ(Describe(finder, {}), "no board seen");
  EXPECT_EQ(Describe(finder, {.is_mirrored = true}), "mirrored");
  EXPECT_EQ(Describe(finder, Seen(4, 8)), "4 x 8 inner corners seen, not all of 5 x 8");
  EXPECT_EQ(Describe(finder, Seen(9, 8)), "9 x 8 inner corners seen, not 5 x 8");
}

}  // namespace
}  // namespace poselift
