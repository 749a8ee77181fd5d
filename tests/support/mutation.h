// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace poselift::testing {

// What can happen to a file: cut off after every byte (of more than `count` bytes, at about as
// many places), and `count` random copies with bits flipped, bytes removed, doubled, taken from
// elsewhere or replaced by words that mean something in JSON, YAML and the like.
std::vector<std::string> DamagedCopies(const std::string& text, int count, std::mt19937_64* rng);

// The bytes of a file; fails the running test when it cannot be read.
std::string FileText(const std::filesystem::path& path);

}  // namespace poselift::testing
