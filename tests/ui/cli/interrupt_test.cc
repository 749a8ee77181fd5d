// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>

namespace poselift::cli {
namespace {

int seen_before = 0;

TEST(Interrupt, EndsALoopAndNotTheProgramAndOnlyWhileItLives) {
  const auto handler = std::signal(SIGTERM, [](int) { ++seen_before; });
  for (const int number : {SIGINT, SIGTERM}) {
    const Interrupt interrupt;
    EXPECT_FALSE(interrupt.asked());
    std::raise(number);
    EXPECT_TRUE(interrupt.asked());
  }
  EXPECT_EQ(seen_before, 0);
  std::raise(SIGTERM);
  EXPECT_EQ(seen_before, 1);
  std::signal(SIGTERM, handler);
}

}  // namespace
}  // namespace poselift::cli
