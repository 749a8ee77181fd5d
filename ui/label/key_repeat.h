// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>

#include "ui/label/key_map.h"

namespace poselift {

// A key that is held goes faster after a while: how many pictures each of its repeats goes.
class KeyRepeat {
 public:
  int Step(double now_s) {
    constexpr double kPause_s = 0.25;
    constexpr int kFaster = 20, kFastest = 60;  // repeats
    count_ = last_s_ && now_s - *last_s_ < kPause_s ? count_ + 1 : 0;
    last_s_ = now_s;
    return count_ < kFaster ? 1 : count_ < kFastest ? 2 : 5;
  }

 private:
  std::optional<double> last_s_;
  int count_ = 0;
};

// What a key shows or hides stays so when it was struck; held, it was a peek.
class KeyPeek {
 public:
  void Press(Action action, double now_s) {
    action_ = action;
    pressed_s_ = now_s;
  }
  // What is to be taken back.
  std::optional<Action> Release(Action action, double now_s) {
    constexpr double kHeld_s = 0.4;
    if (action_ != action) return std::nullopt;
    action_.reset();
    return now_s - pressed_s_ > kHeld_s ? std::optional(action) : std::nullopt;
  }

 private:
  std::optional<Action> action_;
  double pressed_s_ = 0.0;
};

// Digits typed one after the other are one number, as far as it is one of 1 to `count`; a 0 that
// stands alone is 10.
class TypedNumber {
 public:
  int Type(int digit, int count, double now_s) {
    constexpr double kPause_s = 0.8;
    const bool goes_on = last_s_ && now_s - *last_s_ < kPause_s && 10 * number_ + digit <= count;
    number_ = goes_on ? 10 * number_ + digit : digit == 0 ? 10 : digit;
    last_s_ = now_s;
    return number_;
  }

 private:
  std::optional<double> last_s_;
  int number_ = 0;
};

}  // namespace poselift
