// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace poselift {

// Numbers as text in any locale, appended. value is finite and below 1e15.

// At most `digits` significant digits, as short as they allow: 6.18215.
inline void AppendGeneral(double value, int digits, std::string* text) {
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr;
  text->append(buffer, end);
}

// Fixed decimals, no exponent, no minus before nought: 6.182150.
inline void AppendFixed(double value, int decimals, std::string* text) {
  char buffer[64];
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0.0;
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals).ptr;
  text->append(buffer, end);
}

}  // namespace poselift
