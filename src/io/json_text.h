// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <string_view>

namespace poselift {

// Pieces of a JSON text, appended to *out. What is not UTF-8 in a string
// becomes the replacement character.
void AppendJsonString(std::string_view text, std::string* out);

// Rounded to at most `decimals` digits behind the point, without idle zeros.
// Throws std::invalid_argument for NaN and infinity: JSON has none.
void AppendJsonNumber(double value, int decimals, std::string* out);

}  // namespace poselift
