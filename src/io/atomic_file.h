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

// Makes the folder that a file is to stand in, before the work that makes the file. Throws
// InputError where that cannot be, or the folder cannot be written to.
void PrepareFolderOf(const std::filesystem::path& path);

}  // namespace poselift
