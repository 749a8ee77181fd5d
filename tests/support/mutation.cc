// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/mutation.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string_view>

namespace poselift::testing {
namespace {

size_t Below(size_t bound, std::mt19937_64* rng) {
  return std::uniform_int_distribution<size_t>(0, bound - 1)(*rng);
}

void Damage(std::string* text, std::mt19937_64* rng) {
  using namespace std::string_view_literals;
  constexpr std::string_view kTelling = "[]{}:,-\"\\ \n\t0e9%!&*#\0\xff"sv;
  if (text->empty()) return;
  const size_t at = Below(text->size(), rng);
  const size_t length = 1 + Below(20, rng);
  switch (Below(4, rng)) {
    case 0:
      (*text)[at] = static_cast<char>((*text)[at] ^ (1 << Below(8, rng)));
      break;
    case 1:
      text->erase(at, length);
      break;
    case 2:
      text->insert(at, text->substr(at, length));
      break;
    default:
      (*text)[at] = kTelling[Below(kTelling.size(), rng)];
  }
}

}  // namespace

std::vector<std::string> DamagedCopies(const std::string& text, int count, std::mt19937_64* rng) {
  std::vector<std::string> copies;
  for (size_t length = 0; length < text.size(); ++length) copies.push_back(text.substr(0, length));
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
