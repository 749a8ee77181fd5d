// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lift/dictionary.h"

namespace poselift {

// Where one matrix of a dictionary file stands. Numbers are float64, column by
// column; the offset counts bytes from the first array's place.
struct StoredArray {
  std::string name;
  Eigen::Index rows = 0;
  Eigen::Index cols = 0;
  std::uint64_t offset = 0;
};

// The JSON header of a dictionary file (docs/FORMATS.md): all of the dictionary
// but its matrices, and the table of these. The same input gives the same text;
// what is not UTF-8 in a string becomes the replacement character.
std::string DictionaryHeaderText(const Dictionary& dictionary,
                                 const std::vector<StoredArray>& arrays);

// The way back. Fills *dictionary but for its matrices and returns their table.
// Checks that every value is there and of its kind, and the joint names; sizes,
// offsets and meaning are the caller's to check (DictionaryFlaw).
// file: the name for messages. Throws InputError.
std::vector<StoredArray> ParseDictionaryHeader(std::string_view text, const std::string& file,
                                               Dictionary* dictionary);

}  // namespace poselift
