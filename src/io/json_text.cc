// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/json_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace poselift {

void AppendJsonString(std::string_view text, std::string* out) {
  *out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void AppendJsonNumber(double value, int decimals, std::string* out) {
  if (!std::isfinite(value)) throw std::invalid_argument("a JSON file cannot hold NaN or infinity");
  // The digits of a larger number are all before the point, and are many.
  if (std::abs(value) >= 1e15) {
    fmt::format_to(std::back_inserter(*out), "{}", value);
    return;
  }
  const size_t start = out->size();
  fmt::format_to(std::back_inserter(*out), "{:.{}f}", value, decimals);
  if (decimals > 0) {
    out->erase(out->find_last_not_of('0') + 1);
    if (out->back() == '.') out->pop_back();
  }
  if (std::string_view(*out).substr(start) == "-0") out->erase(start, 1);
}

}  // namespace poselift
