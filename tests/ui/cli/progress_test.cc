// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The bar is real; the terminal is a string stream and time is a variable.
// Checked: what is drawn when, and that nothing of it stays on the line.
#include "ui/cli/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <thread>
#include <vector>

namespace poselift::cli {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class ProgressTest : public ::testing::Test {
 protected:
  Progress Bar(int64_t num_items = 0, bool is_terminal = true) {
    return {"train", num_items, "poses", &terminal_, is_terminal, [this] { return now_s_; }};
  }

  std::ostringstream terminal_;
  double now_s_ = 100.0;
};

TEST_F(ProgressTest, ShowsBarRateAndTimeLeft) {
  Progress bar = Bar(5000);
  now_s_ += 2.0;
  bar.Advance(0.4);
  EXPECT_EQ(terminal_.str(),
            "\r\x1b[Ktrain  [########------------]  40 %  1000 poses/s  0:03 left");
}

TEST_F(ProgressTest, ShowsNothingInTheFirstSecond) {
  {
    Progress bar = Bar();
    now_s_ += 0.99;
    bar.Advance(0.5);
  }
  EXPECT_EQ(terminal_.str(), "");
}

TEST_F(ProgressTest, ShowsNothingWhenStderrIsNoTerminal) {
  {
    Progress bar = Bar(0, false);
    now_s_ += 60.0;
    bar.Advance(0.5);
  }
  EXPECT_EQ(terminal_.str(), "");
}

TEST_F(ProgressTest, IsErasedAtTheEnd) {
  {
    Progress bar = Bar();
    now_s_ += 2.0;
    bar.Advance(1.0);
    EXPECT_THAT(terminal_.str(), HasSubstr("[####################] 100 %  0:00 left"));
  }
  EXPECT_THAT(terminal_.str(), EndsWith("left\r\x1b[K"));
}

TEST_F(ProgressTest, DrawsAtMostTenTimesASecond) {
  Progress bar = Bar();
  now_s_ += 2.0;
  bar.Advance(0.1);
  const std::string first = terminal_.str();
  now_s_ += 0.05;
  bar.Advance(0.2);
  EXPECT_EQ(terminal_.str(), first);
  now_s_ += 0.06;
  bar.Advance(0.3);
  EXPECT_THAT(terminal_.str(), HasSubstr("30 %"));
}

TEST_F(ProgressTest, IgnoresStepsBackAndNan) {
  Progress bar = Bar();
  now_s_ += 2.0;
  bar.Advance(0.5);
  const std::string before = terminal_.str();
  now_s_ += 1.0;
  bar.Advance(0.4);
  bar.Advance(0.0);
  bar.Advance(std::nan(""));
  EXPECT_EQ(terminal_.str(), before);
}

TEST_F(ProgressTest, StaysWithinOneLineForLongTitlesAndTimes) {
  Progress bar(std::string(100, 'x'), 0, "", &terminal_, true, [this] { return now_s_; });
  now_s_ += 1e9;
  bar.Advance(1e-300);
  EXPECT_LE(terminal_.str().size(), 79 + std::string("\r\x1b[K").size());
}

TEST_F(ProgressTest, WholeLinesWhenManyThreadsAdvance) {
  Progress bar = Bar();
  now_s_ += 2.0;  // then time stands still: the first call alone may draw
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([callback = bar.Callback(), t] {
      for (int i = 1; i <= 1000; ++i) callback((i + 0.1 * t) / 1001.0);
    });
  for (std::thread& thread : threads) thread.join();
  const std::string drawn = terminal_.str();
  EXPECT_EQ(drawn.find('\r'), drawn.rfind('\r'));
  EXPECT_THAT(drawn, EndsWith(" left"));
}

}  // namespace
}  // namespace poselift::cli
