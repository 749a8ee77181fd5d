// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>

#include "lift/dictionary.h"

namespace poselift {

// A dictionary as one file (.pldict), little-endian; docs/FORMATS.md has it all:
//
//   "PLDICT\r\n"  u32 version  u64 header bytes  u64 file bytes
//   JSON header: joint names, skeleton, training record, table of the arrays
//   arrays, each at a multiple of 64 bytes: atoms, prior mean, prior whitening
//   u32 CRC-32 of all bytes before it
//
// What is read is, to the last bit, what was written (strings: when they are
// UTF-8). The same dictionary gives the same bytes.

// Written as WriteFileAtomically does. Throws InputError when the file cannot be
// written, std::invalid_argument for a dictionary with a DictionaryFlaw.
void WriteDictionary(const Dictionary& dictionary, const std::filesystem::path& path);

// Throws InputError that says what is wrong: no dictionary file, one of a newer
// version, cut short, altered, or with content that DictionaryFlaw refuses.
Dictionary ReadDictionary(const std::filesystem::path& path);

}  // namespace poselift
