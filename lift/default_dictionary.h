// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <vector>

namespace poselift {

// The dictionary file to use when the user names none: the one that the
// environment variable POSELIFT_DICTIONARY names, else the first that is there
// of DefaultModelPlaces for the running program.
// Throws InputError when the variable names no file, or when there is none in
// any of the places; the message lists them.
std::filesystem::path DefaultDictionaryPath();

// The same of the motion codebook, whose variable is POSELIFT_MOTION_MODEL.
std::filesystem::path DefaultMotionModelPath();

enum class DefaultModel { kDictionary, kMotion };

// Where a program (its full path, may be empty) looks, in this order:
//  1. <its folder>/../share/poselift: installed beside it;
//  2. data/ of the source tree, for a program of the build tree alone;
//  3. the data folder of the prefix that the library was configured for.
std::vector<std::filesystem::path> DefaultModelPlaces(DefaultModel model,
                                                      const std::filesystem::path& program);

// The first that is a file. Throws InputError that lists the places.
std::filesystem::path FirstModelOf(DefaultModel model,
                                   const std::vector<std::filesystem::path>& places);

}  // namespace poselift
