// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QString>
#include <filesystem>
#include <iterator>
#include <string_view>

namespace poselift {

// Texts of the core for the screen.
inline QString TextOf(std::string_view text) {
  return QString::fromUtf8(text.data(), std::ssize(text));
}
inline QString TextOf(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace poselift
