// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lift/dictionary.h"
#include "src/io/json_value.h"

namespace poselift {

// The JSON header of a dictionary file (docs/FORMATS.md): all of the dictionary
// but its matrices. The same input gives the same header.
nlohmann::ordered_json DictionaryHeader(const Dictionary& dictionary);

// The way back. Fills *dictionary but for its matrices. Checks that every value
// is there and of its kind, and the joint names; the meaning is the caller's to
// check (DictionaryFlaw). Throws InputError.
void ReadDictionaryHeader(const JsonValue& root, Dictionary* dictionary);

}  // namespace poselift
