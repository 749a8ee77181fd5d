// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string_view>

namespace poselift {

// Writes a file so that whoever opens it sees the old bytes or all of the new
// ones, never a part: into a temporary file of the same folder, flushed to the
// disk, then renamed. A symbolic link keeps pointing where it did; a device or
// a pipe (/dev/stdout) is written to directly.
// Throws InputError, and leaves no temporary file, when anything fails.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace poselift
