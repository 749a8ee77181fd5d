// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Words, lines and numbers of text files, and files that are no text. Real
// files in the scratch folder.
#include "src/io/text_scanner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/input_error.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::ScratchDir;
using testing::WriteScratch;

std::string ErrorOfNumber(const std::string& word) {
  TextScanner scanner(WriteScratch("n.txt", "\n" + word + "\n"), {});
  try {
    scanner.NextLine();
    scanner.Number("a number");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TextScanner, ReadsWordsOverLinesCommentsAndCarriageReturns) {
  TextScanner scanner(WriteScratch("a.txt", "\xEF\xBB\xBFone\ttwo # no\r\n\r\n# no\r\n(three) x#y"),
                      {.comment = '#', .extra_blanks = "()"});
  EXPECT_EQ(scanner.Word(), "one");
  EXPECT_EQ(scanner.Word(), "two");
  EXPECT_EQ(scanner.Word(), "");
  EXPECT_EQ(scanner.PeekOnAnyLine(), "three");
  EXPECT_EQ(scanner.line(), 1);
  EXPECT_EQ(scanner.WordOnAnyLine(), "three");
  EXPECT_EQ(scanner.line(), 4);
  EXPECT_EQ(scanner.Word(), "x#y");
  EXPECT_TRUE(scanner.AtLineEnd());
  EXPECT_FALSE(scanner.NextLine());
  EXPECT_EQ(scanner.WordOnAnyLine(), "");
}

TEST(TextScanner, ReadsEveryWayToWriteANumber) {
  TextScanner scanner(
      WriteScratch("a.txt", ".0083333 -.5 5. +2 1e3 7.62852e-016 1e-400 -0 0.0000000001"), {});
  for (const double expected : {.0083333, -.5, 5.0, 2.0, 1e3, 7.62852e-16, 0.0, 0.0, 1e-10})
    EXPECT_EQ(scanner.Number("a number"), expected);
  EXPECT_TRUE(scanner.AtLineEnd());
}

TEST(TextScanner, RefusesWhatIsNoFiniteNumber) {
  for (const char* word : {"nan", "inf", "-inf", "1e999", "1e10", "1,5", "abc", "1.2.3", "0x10",
                           "1.#QNAN", "+-1", "-", "+", "--1", ""})
    EXPECT_THAT(ErrorOfNumber(word), HasSubstr("wanted a number")) << word;
  EXPECT_THAT(ErrorOfNumber("1,5"), HasSubstr("n.txt:2: found \"1,5\""));
}

TEST(TextScanner, TakesInfinityOnlyWhereItIsWanted) {
  TextScanner scanner(WriteScratch("a.txt", "inf -INF 3 nan"), {});
  EXPECT_EQ(scanner.NumberOrInfinity("a limit"), HUGE_VAL);
  EXPECT_EQ(scanner.NumberOrInfinity("a limit"), -HUGE_VAL);
  EXPECT_EQ(scanner.NumberOrInfinity("a limit"), 3.0);
  EXPECT_THROW(scanner.NumberOrInfinity("a limit"), InputError);
}

TEST(TextScanner, QuotesStrangeWordsSafely) {
  EXPECT_EQ(Quoted("a\x01\xFFz"), "\"a??z\"");
  EXPECT_EQ(Quoted(std::string(1000, 'x')).size(), 45u);
}

TEST(ReadTextFile, RefusesWhatIsNoTextFile) {
  EXPECT_THROW(ReadTextFile(ScratchDir()), InputError);
  EXPECT_THROW(ReadTextFile(ScratchDir() / "absent"), InputError);
  EXPECT_THROW(ReadTextFile(WriteScratch("binary", std::string("a\0b", 3))), InputError);
  EXPECT_EQ(ReadTextFile(WriteScratch("empty", "")), "");
}

}  // namespace
}  // namespace poselift
