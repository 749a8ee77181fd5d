// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>

#include "lift/dictionary.h"

namespace poselift {

// A dictionary as one file (.pldict), an array file (array_file.h) of atoms, prior
// mean and prior whitening; docs/FORMATS.md has it all. What is read is, to the
// last bit, what was written. The same dictionary gives the same bytes.

// Written as WriteFileAtomically does. Throws InputError when the file cannot be
// written, std::invalid_argument for a dictionary with a DictionaryFlaw.
void WriteDictionary(const Dictionary& dictionary, const std::filesystem::path& path);

// Throws InputError that says what is wrong: no dictionary file, one of a newer
// version, cut short, altered, or with content that DictionaryFlaw refuses.
Dictionary ReadDictionary(const std::filesystem::path& path);

}  // namespace poselift
