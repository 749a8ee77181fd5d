// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/mutation.h"
#include "tests/support/readers.h"
#include "tests/support/support.h"

// The rows of Readers(), by what is read.
namespace poselift::testing {

std::vector<Reader> MotionReaders();
std::vector<Reader> LabelReaders();
std::vector<Reader> CameraAndTagReaders();
std::vector<Reader> ModelReaders();
std::vector<Reader> PictureReaders();
std::vector<Reader> WindowReaders();

inline void WriteBytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

// What a file may be at first: this text,
inline auto Text(std::string text) {
  return [text = std::move(text)](const std::filesystem::path&) { return text; };
}

// what write(path) writes,
template <typename Write>
auto Written(const std::string& file, Write write) {
  return [file, write](const std::filesystem::path& dir) {
    write(dir / file);
    return FileText(dir / file);
  };
}

// or a file of tests/golden.
inline auto Golden(const std::string& file) {
  return
      [file](const std::filesystem::path&) { return FileText(SourcePath("tests/golden/" + file)); };
}

}  // namespace poselift::testing
