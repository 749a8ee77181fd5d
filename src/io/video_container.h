// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <filesystem>

namespace poselift {

// How many bytes the file lacks by the sizes its own container states (MP4,
// QuickTime, AVI, Matroska); 0 for a whole file and for what states no size.
// Decoders take a file that was cut short for one that ends.
uint64_t MissingBytes(const std::filesystem::path& path);

}  // namespace poselift
