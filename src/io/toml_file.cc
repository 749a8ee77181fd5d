// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/toml_file.h"

#include <fmt/format.h>

#include <string_view>

#include "src/input_error.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

// a.b.c is a table in a table: toml++ bounds how deep brackets nest, but not dots, and a tree too
// deep is taken down by a call a level until the stack ends.
void CheckDots(const std::filesystem::path& path, std::string_view text) {
  constexpr int kMostDots = 48;
  int line = 1, dots = 0;
  bool is_comment = false, at_start = true;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      dots = 0;
      at_start = true;
      continue;
    }
    if (at_start) is_comment = c == '#';
    at_start = at_start && (c == ' ' || c == '\t');
    if (c == '.' && !is_comment && ++dots > kMostDots)
      throw InputError(path, line, fmt::format("found more than {} dots, wanted fewer", kMostDots));
  }
}

}  // namespace

toml::table ReadToml(const std::filesystem::path& path, std::string_view wanted) {
  const std::string text = ReadTextFile(path);
  CheckDots(path, text);
  try {
    return toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    throw InputError(path, static_cast<int>(error.source().begin.line),
                     fmt::format("found no TOML ({}), wanted {}", error.description(), wanted));
  }
}

}  // namespace poselift
