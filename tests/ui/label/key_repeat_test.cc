// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/key_repeat.h"

#include <gtest/gtest.h>

namespace poselift {
namespace {

TEST(KeyRepeat, AHeldKeyGoesFasterAndAPauseStartsAnew) {
  KeyRepeat repeat;
  int pictures = 0;
  for (int i = 0; i < 20; ++i) pictures += repeat.Step(0.03 * i);
  EXPECT_EQ(pictures, 20);
  EXPECT_EQ(repeat.Step(0.60), 2);
  for (int i = 21; i < 60; ++i) repeat.Step(0.03 * i);
  EXPECT_EQ(repeat.Step(1.80), 5);
  EXPECT_EQ(repeat.Step(2.50), 1);
}

TEST(KeyPeek, OnlyAKeyThatWasHeldIsTakenBack) {
  KeyPeek peek;
  peek.Press(Action::kToggleLabels, 1.0);
  EXPECT_EQ(peek.Release(Action::kToggleLabels, 1.1), std::nullopt);
  peek.Press(Action::kToggleLabels, 2.0);
  EXPECT_EQ(peek.Release(Action::kToggleEdges, 3.0), std::nullopt);  // of another key
  EXPECT_EQ(peek.Release(Action::kToggleLabels, 3.0), Action::kToggleLabels);
  EXPECT_EQ(peek.Release(Action::kToggleLabels, 4.0), std::nullopt);
}

TEST(TypedNumber, DigitsInARowAreOneNumberAsFarAsThereIsOne) {
  TypedNumber number;
  EXPECT_EQ(number.Type(1, 15, 0.0), 1);
  EXPECT_EQ(number.Type(4, 15, 0.3), 14);
  EXPECT_EQ(number.Type(2, 15, 0.5), 2);
  EXPECT_EQ(number.Type(3, 15, 2.0), 3);
  EXPECT_EQ(number.Type(0, 15, 9.0), 10);
}

}  // namespace
}  // namespace poselift
