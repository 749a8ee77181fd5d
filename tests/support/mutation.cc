// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/mutation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string_view>

namespace poselift::testing {
namespace {

using namespace std::string_view_literals;

size_t Below(size_t bound, std::mt19937_64* rng) {
  return std::uniform_int_distribution<size_t>(0, bound - 1)(*rng);
}

// What means something in one of the formats, or is a number that not all take.
constexpr std::array kTelling = {
    "["sv,   "]"sv,     "{"sv,       "}"sv,   "("sv,         ":"sv,     ","sv,   "-"sv,
    "\""sv,  "\\"sv,    " "sv,       "\n"sv,  "\r"sv,        "\t"sv,    "%"sv,   "!"sv,
    "&"sv,   "*"sv,     "#"sv,       "\0"sv,  "\xFF\xFE"sv,  "0"sv,     "-1"sv,  "1e9"sv,
    "nan"sv, "1e999"sv, "-1e-999"sv, "inf"sv, "999999999"sv, ":root"sv, "end"sv, "CHANNELS 6"sv};

void Damage(std::string* text, std::mt19937_64* rng) {
  if (text->empty()) return;
  const size_t at = Below(text->size(), rng);
  const size_t length = 1 + Below(20, rng);
  switch (Below(5, rng)) {
    case 0:
      (*text)[at] = static_cast<char>((*text)[at] ^ (1 << Below(8, rng)));
      break;
    case 1:
      text->erase(at, length);
      break;
    case 2:
      text->insert(at, text->substr(at, length));
      break;
    case 3:
      text->insert(at, text->substr(Below(text->size(), rng), length));
      break;
    default:
      text->replace(at, Below(2, rng) * length, kTelling[Below(kTelling.size(), rng)]);
  }
}

}  // namespace

std::vector<std::string> DamagedCopies(const std::string& text, int count, std::mt19937_64* rng) {
  std::vector<std::string> copies;
  const size_t step = std::max<size_t>(1, text.size() / static_cast<size_t>(count));
  for (size_t length = 0; length < text.size(); length += step)
    copies.push_back(text.substr(0, length));
  for (int i = 0; i < count; ++i) {
    copies.push_back(text);
    for (size_t k = 0; k <= Below(3, rng); ++k) Damage(&copies.back(), rng);
  }
  return copies;
}

std::string FileText(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) ADD_FAILURE() << "cannot read " << path;
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

}  // namespace poselift::testing
